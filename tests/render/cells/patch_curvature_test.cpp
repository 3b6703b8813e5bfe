#include "hiac/render/cells/curved/patch_curvature.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace hiac {
namespace {

// A coordinate in Bernstein form, by its own definition.
double value_at(std::size_t degree, const PatchNet<double>& net, double u, double v) {
  const auto basis = [&](std::size_t i, double x) {
    constexpr double kBinomial[4][4] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}};
    return kBinomial[degree][i] * std::pow(x, i) * std::pow(1 - x, degree - i);
  };
  double sum = 0;
  for (std::size_t j = 0; j <= degree; ++j)
    for (std::size_t i = 0; i <= degree; ++i)
      sum += net[i + (degree + 1) * j] * basis(i, u) * basis(j, v);
  return sum;
}

// How far the coordinate is, this far from a place, from the linear one that touches it there.
double deviation(std::size_t degree, const PatchNet<double>& net, double u, double v, double by_u,
                 double by_v) {
  const double h = 1e-4;  // central differences of cubics are exact to h^2
  const auto at = [&](double a, double b) { return value_at(degree, net, a, b); };
  // of the derivative of a cubic, by Richardson's extrapolation: exact
  const auto slope = [&](const std::function<double(double)>& f) {
    const double one = (f(h) - f(-h)) / (2 * h), two = (f(2 * h) - f(-2 * h)) / (4 * h);
    return (4 * one - two) / 3;
  };
  const double slope_u = slope([&](double x) { return at(u + x, v); });
  const double slope_v = slope([&](double x) { return at(u, v + x); });
  return std::abs(at(u + by_u, v + by_v) - at(u, v) - slope_u * by_u - slope_v * by_v);
}

// u^2, v^2, u^3 and u v have the largest second derivatives that their coefficients allow: nothing
// but the border's factor is lost.
TEST(PatchCurvature, IsSharpForMonomials) {
  struct Monomial {
    std::size_t degree;
    double u, v;      // where it bends most
    bool of_u, of_v;  // a power of that alone, or both: the product
  };
  for (const Monomial& m : {Monomial{2, 0, 0, true, false}, Monomial{2, 0, 0, false, true},
                            Monomial{3, 1, 0, true, false}, Monomial{3, 0, 1, false, true},
                            Monomial{1, 0, 0, true, true}, Monomial{2, 0.5, 0.5, true, true},
                            Monomial{3, 1, 1, true, true}}) {
    PatchNet<double> net{};
    const std::size_t n = m.degree;
    const auto side = static_cast<double>(n);
    for (std::size_t j = 0; j <= n; ++j)
      for (std::size_t i = 0; i <= n; ++i)
        net[i + (n + 1) * j] = m.of_u && m.of_v ? static_cast<double>(i * j) / (side * side)
                               : (m.of_u ? i == n : j == n) ? 1.0
                                                            : 0.0;
    const double step = 0.01;
    const double by_u = m.of_u ? step : 0, by_v = m.of_v ? step : 0;
    const double bound = PatchCurvature(n, net).within(by_u, by_v);
    const double error = deviation(n, net, m.u, m.v, by_u, by_v);
    EXPECT_GE(bound, error) << n << m.of_u << m.of_v;
    EXPECT_LE(bound, 1.5 * error) << n << m.of_u << m.of_v;
    // other directions are straight
    EXPECT_LT(PatchCurvature(n, net).within(m.of_u ? 0 : step, m.of_u ? step : 0), 1e-15);
  }
}

// Coefficients of alternating signs are larger outside the square than on it.
TEST(PatchCurvature, HoldsOnTheBorder) {
  PatchNet<double> net{};
  // the differences of a cubic's second differences: 1, -1
  const std::array<double, 4> along{0, 0, 1, 1}, across{1, -1, 1, -1};
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) net[i + 4 * j] = along[i] * across[j];
  const double border = PatchCurvature::kBorder, step = border / 8;
  const double error = deviation(3, net, -border + step, -border, step, 0);
  const PatchCurvature curvature(3, net);
  EXPECT_GE(curvature.within(step, 0), error);
  EXPECT_LE(curvature.within(step, 0), 1.5 * error);
  // which the square's own coefficients would not bound
  EXPECT_GT(error, 0.5 * 6 * step * step);
}

TEST(PatchCurvature, HoldsForAnyPatch) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto place = [&] { return 0.5 + (0.5 + PatchCurvature::kBorder) * unit(random); };
  double closest = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const std::size_t n = 1 + static_cast<std::size_t>(trial) % 3;
    PatchNet<double> net{};
    for (double& x : net) x = unit(random);
    const double u = place(), v = place(), to_u = place(), to_v = place();
    const double bound = PatchCurvature(n, net).within(std::abs(to_u - u), std::abs(to_v - v));
    const double error = deviation(n, net, u, v, to_u - u, to_v - v);
    ASSERT_LE(error, bound + 1e-8) << n;
    if (bound > 1e-3) closest = std::max(closest, error / bound);
  }
  EXPECT_GT(closest, 0.7);
}

}  // namespace
}  // namespace hiac
