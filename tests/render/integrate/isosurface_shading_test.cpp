#include "hiac/render/integrate/isosurface_shading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace hiac {
namespace {

using Direction = std::array<double, 3>;

Direction random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Direction v{normal(random), normal(random), normal(random)};
  const double length = std::hypot(v[0], v[1], v[2]);
  for (double& x : v) x /= length;
  return v;
}

long double dot(const Direction& a, const Direction& b) {
  long double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += static_cast<long double>(a[c]) * b[c];
  return sum;
}

// Phong's formula as the header has it, with vectors: rgb and transparency.
std::array<long double, 4> truth(const SurfaceLook& look, const std::vector<FrameLight>& lights,
                                 const ShadedPoint& point) {
  const long double side = dot(point.normal, point.ray) > 0 ? -1 : 1;
  const long double facing = std::abs(dot(point.normal, point.ray));
  const long double transparency = std::exp(look.log_transparency / facing);
  std::array<long double, 4> seen{0, 0, 0, transparency};
  for (std::size_t c = 0; c < 3; ++c) {
    long double light = static_cast<long double>(look.ambient) * point.color[c];
    for (const FrameLight& l : lights) {
      Direction to_light = l.direction;
      if (l.headlight)
        for (std::size_t k = 0; k < 3; ++k) to_light[k] = -point.ray[k];
      const long double lit = side * dot(point.normal, to_light);
      if (lit <= 0) continue;
      long double mirrored = 0;  // R.V
      for (std::size_t k = 0; k < 3; ++k)
        mirrored -= (2 * lit * side * point.normal[k] - to_light[k]) * point.ray[k];
      light += l.color[c] * (look.diffuse * lit * point.color[c] +
                             look.specular * std::pow(std::max(mirrored, 0.0L), look.shininess));
    }
    seen[c] = light * (1 - transparency);
  }
  return seen;
}

TEST(IsosurfaceShading, IsPhongsOfEveryPointOfAnyNumber) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share;
  for (std::size_t round = 0; round < 300; ++round) {
    const SurfaceLook look{{share(random), share(random), share(random)},
                           std::log1p(-share(random)),
                           share(random),
                           share(random),
                           round % 3 == 0 ? 0 : share(random),
                           1 + 60 * share(random)};
    std::vector<FrameLight> lights;
    for (std::size_t k = 0; k < round % 4; ++k)
      lights.push_back({k == 1, random_direction(random), {share(random), 1, share(random)}});
    std::vector<ShadedPoint> points(round % 19);
    for (ShadedPoint& point : points)
      point = {random_direction(random),
               random_direction(random),
               {share(random), share(random), share(random)},
               {}};
    shade_points(look, lights, points);
    for (const ShadedPoint& point : points) {
      const auto expected = truth(look, lights, point);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(point.shade.rgb[c], static_cast<double>(expected[c]), 3e-14) << round;
      EXPECT_NEAR(point.shade.transparency, static_cast<double>(expected[3]), 1e-14) << round;
      SurfaceLook own = look;
      own.color = point.color;
      const IsosurfaceShade alone = shade_isosurface(own, lights, point.normal, point.ray);
      EXPECT_EQ(point.shade.rgb, alone.rgb) << round;
      EXPECT_EQ(point.shade.transparency, alone.transparency) << round;
    }
  }
}

}  // namespace
}  // namespace hiac
