#include "hiac/preview/methods/effective_color.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "hiac/preview/methods/gaussian_tables.hpp"

namespace hiac::preview {
namespace {

// Light of a region by the composite midpoint rule, without background: the definition.
std::array<double, 2> light(Glow glow, double length, const RayEnd& front, const RayEnd& back) {
  constexpr int kSteps = 4000;
  double light = 0, depth = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double u = (k + 0.5) / kSteps, step = length / kSteps;
    const double tau = front.tau + u * (back.tau - front.tau);
    const double color = front.color[0] + u * (back.color[0] - front.color[0]);
    const double source = glow == Glow::emission ? color : color * tau;
    light += std::exp(-depth - tau * step / 2) * source * step;
    depth += tau * step;
  }
  return {light, depth};
}

TEST(GaussianTables, HaveTheIntegrals) {
  const GaussianTables tables;
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; ++i) {
    const double x = std::uniform_real_distribution<double>(0, GaussianTables::kRange)(random);
    EXPECT_NEAR(tables.falling(x), std::sqrt(M_PI) / 2 * std::erf(x), 1e-12);
    // Dawson's series in a way that does not cancel: sum of x^(2k+1) / (k! (2k+1))
    long double sum = 0, term = x;
    for (int k = 0; k < 400; ++k) {
      sum += term / (2 * k + 1);
      term *= static_cast<long double>(x) * x / (k + 1);
    }
    EXPECT_NEAR(tables.growing(x) / static_cast<double>(sum), 1, 1e-12) << x;
  }
}

// What a pixel gets of a vertex' colour (shaders.cpp) is the light of the definition.
TEST(EffectiveColor, GivesTheLightOfTheRay) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> any(0, 1);
  for (const Method method : {Method::tables, Method::exact_at_vertices})
    for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
      const EffectiveColor colors(method, glow);
      int reverted = 0;
      for (int i = 0; i < 3000; ++i) {
        const double size = std::pow(10, -6 + 8 * any(random));
        const RayEnd front{size * any(random), {any(random)}};
        const RayEnd back{i % 10 == 0  ? front.tau
                          : i % 3 == 0 ? front.tau * (1 + 1e-4 * any(random))
                                       : size * any(random),
                          {any(random)}};
        const double length = 0.5 + any(random);
        bool is_reverted = false;
        const double color = colors.at(length, front, back, is_reverted)[0];
        reverted += is_reverted ? 1 : 0;
        if (is_reverted) {
          EXPECT_DOUBLE_EQ(color, (front.color[0] + back.color[0]) / 2);
          continue;
        }
        const auto [truth, depth] = light(glow, length, front, back);
        const double ratio =
            glow == Glow::emission ? length * opacity_ratio(depth) : -std::expm1(-depth);
        const double unit = glow == Glow::emission ? length : -std::expm1(-depth);
        EXPECT_NEAR(color * ratio / unit, truth / unit, 2e-4 + 1e-6 * size * size)
            << front.tau << ' ' << back.tau << ' ' << length;
      }
      if (method == Method::tables)
        EXPECT_GT(reverted, 100);
      else
        EXPECT_EQ(reverted, 0);
    }
}

TEST(EffectiveColor, HasALimitAtNoLength) {
  const RayEnd front{3, {1, 0, 0}}, back{1, {0, 1, 0}};
  bool reverted = false;
  for (const Method method : {Method::tables, Method::exact_at_vertices}) {
    const EffectiveColor colors(method, Glow::chromaticity);
    const auto limit = colors.at(0, front, back, reverted);
    // int (1 - u) tau over int tau, tau = 3 - 2 u
    EXPECT_NEAR(limit[0], 7.0 / 12, 1e-12);
    EXPECT_NEAR(limit[1], 5.0 / 12, 1e-12);
    EXPECT_NEAR(colors.at(1e-5, front, back, reverted)[0], limit[0], 1e-4);
    EXPECT_EQ(colors.at(2, {0, {1, 0, 0}}, {0, {0, 0, 1}}, reverted)[2], 0.5);
    EXPECT_FALSE(reverted);
  }
  const EffectiveColor mean(Method::mean_color, Glow::chromaticity);
  EXPECT_EQ(mean.at(2, front, back, reverted)[0], 0.5);
}

}  // namespace
}  // namespace hiac::preview
