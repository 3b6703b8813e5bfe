// The bounds of a gradient's length and condition, and the error of a normal that they bound.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "hiac/base/rounding.hpp"
#include "hiac/base/special_values.hpp"
#include "hiac/element/gradient/gradient_direction.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/render/bounds/error_bound.hpp"
#include "hiac/render/bounds/rounding_counts.hpp"
#include "tests/render/bounds/expect_same.hpp"

namespace hiac {
namespace {

using test::expect_same;

constexpr double u = kUnit;

// Edges (1, 0, 0), (0, 1, 0), (1, 1, h): of volume h, less 16 u times the product of their lengths.
TEST(GradientLength, AllowsForRoundingOfFlatTetrahedra) {
  const double root = std::numbers::sqrt2;
  const auto edges = [](double h) {
    return std::array<Vector, 3>{{{1, 0, 0}, {0, 1, 0}, {1, 1, h}}};
  };
  const auto volume = [&](double h) { return h - 16 * u * std::sqrt(2 + h * h); };
  // the difference along the first edge alone: (h, 0, -1) by the volume
  expect_same(gradient_length(edges(64 * u), {1, 0, 0}), (1 + 16 * u * root) / volume(64 * u));
  // x + y, whose gradient's third component cancels: 16 u of all that is added up counts
  expect_same(gradient_length(edges(32 * u), {1, 1, 2}),
              (32 * u * root + 16 * u * (2 * root + 2)) / volume(32 * u));
  EXPECT_EQ(gradient_length(edges(22 * u), {1, 0, 0}), kInfinity);
}

// Of a field that is c times as steep across as along what is left after cancellation: c + 2 (32 u
// c) c, the second term for the products of errors.
TEST(GradientCondition, IsHowMuchCancels) {
  const std::array<Vector, 3> columns{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  EXPECT_NEAR(gradient_condition(columns, {0, 3, 0}), 1, 1e-13);
  EXPECT_NEAR(gradient_condition(columns, {3, 4, 0}), 7.0 / 5, 1e-13);
  // x + y in the tetrahedron above: sum h sqrt(2) of 2 sqrt(2) + 2
  const double h = 0x1p-45, root = std::numbers::sqrt2;
  const double c = (2 * root + 2) / (h * root);
  const double part = 32 * u * c;
  ASSERT_LT(part, 0.5);
  ASSERT_GT(part, 0.1);
  expect_same(gradient_condition({{{1, 0, 0}, {0, 1, 0}, {1, 1, h}}}, {1, 1, 2}),
              (part + 2 * part * part) / (32 * u));
  EXPECT_EQ(gradient_condition({{{1, 0, 0}, {0, 1, 0}, {1, 1, h / 8}}}, {1, 1, 2}), kInfinity);
}

// How far a direction is from the gradient of exact columns and differences, as the sine of the
// angle between them, with either sign; computed with 113 bits.
double sine_between(const std::array<std::array<__float128, 3>, 3>& columns,
                    const std::array<__float128, 3>& differences, const Vector& direction) {
  std::array<__float128, 3> exact{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& a = columns[(k + 1) % 3];
    const auto& b = columns[(k + 2) % 3];
    for (std::size_t c = 0; c < 3; ++c)
      exact[c] +=
          differences[k] * (a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3]);
  }
  Vector across;
  double length = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    across[c] = static_cast<double>(exact[(c + 1) % 3] * direction[(c + 2) % 3] -
                                    exact[(c + 2) % 3] * direction[(c + 1) % 3]);
    length = std::hypot(length, static_cast<double>(exact[c]));
  }
  return hiac::length(across) / length;
}

// The error of a normal is kAngleRounding times the condition of the gradient: of cells ever
// flatter, with fields ever closer to one that does not change across them.
TEST(GradientCondition, BoundsTheErrorOfANormal) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> in(-1, 1);
  std::uniform_int_distribution<int> exponent(-40, 0);
  double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    std::array<std::array<__float128, 3>, 3> columns;
    std::array<__float128, 3> differences;
    const auto drawn = [&] { return __float128{in(random)} + __float128{in(random)} * 0x1p-53; };
    const __float128 flatness = std::ldexp(1.0, exponent(random));
    const __float128 steepness = std::ldexp(1.0, exponent(random));
    const __float128 p = drawn(), q = drawn();
    for (std::size_t c = 0; c < 3; ++c) {
      columns[0][c] = drawn();
      columns[1][c] = drawn();
      columns[2][c] = p * columns[0][c] + q * columns[1][c] + flatness * drawn();
    }
    differences = {drawn(), drawn(), 0};
    differences[2] = p * differences[0] + q * differences[1] + steepness * drawn();
    std::array<Vector, 3> rounded;
    Vector g;
    for (std::size_t k = 0; k < 3; ++k) {
      g[k] = static_cast<double>(differences[k]);
      for (std::size_t c = 0; c < 3; ++c) rounded[k][c] = static_cast<double>(columns[k][c]);
    }
    const double condition = gradient_condition(rounded, g);
    if (condition == kInfinity) continue;
    const double off = sine_between(columns, differences, gradient_direction(rounded, g));
    worst = std::max(worst, off / (u * condition));
  }
  EXPECT_LE(worst, kAngleRounding);
  EXPECT_GE(worst, 1.5);
}

}  // namespace
}  // namespace hiac
