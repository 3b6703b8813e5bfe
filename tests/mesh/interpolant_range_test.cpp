#include "hiac/mesh/interpolant_range.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

std::vector<CellKind> all_kinds() {
  std::vector<CellKind> kinds;
  for (std::size_t k = 0; k < kKindCount; ++k) kinds.push_back(static_cast<CellKind>(k));
  return kinds;
}

std::vector<double> random_values(CellKind kind, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<double> values(node_count(kind));
  for (double& value : values) value = unit(random);
  return values;
}

std::array<double, 3> in_cell(CellShape shape, double u, double v, double w) {
  switch (shape) {
    case CellShape::tetrahedron:
      return {u * (1 - v) * (1 - w), v * (1 - w), w};
    case CellShape::pyramid:
      return {u * (1 - w), v * (1 - w), w};
    case CellShape::prism:
      return {u * (1 - v), v, w};
    case CellShape::wedge:
      return {u * (2 - v - w), v, w};
    case CellShape::brick:
      break;
  }
  return {u, v, w};
}

double interpolated(CellKind kind, const std::vector<double>& values,
                    const std::array<double, 3>& xi) {
  std::array<double, kMaxNodesPerCell> shape;
  shape_functions<double>(kind, xi, shape);
  double sum = 0;
  for (std::size_t k = 0; k < values.size(); ++k) sum += shape[k] * values[k];
  return sum;
}

double bernstein(std::size_t p, std::size_t i, double t) {
  double b = std::pow(t, static_cast<double>(i)) * std::pow(1 - t, static_cast<double>(p - i));
  for (std::size_t k = 1; k <= i; ++k) b *= static_cast<double>(p - i + k) / static_cast<double>(k);
  return b;
}

TEST(InterpolantRange, CoefficientsGiveTheInterpolantOfEveryKind) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const CellKind kind : all_kinds()) {
    const auto p = static_cast<std::size_t>(order_of(kind));
    const auto values = random_values(kind, random);
    const auto b = interpolant_coefficients(kind, values);
    ASSERT_EQ(b.count, (p + 1) * (p + 1) * (p + 1));
    for (int trial = 0; trial < 200; ++trial) {
      const double u = unit(random), v = unit(random), w = unit(random);
      double sum = 0;
      for (std::size_t i = 0; i < b.count; ++i)
        sum += b.c[i] * bernstein(p, i % (p + 1), u) * bernstein(p, i / (p + 1) % (p + 1), v) *
               bernstein(p, i / (p + 1) / (p + 1), w);
      ASSERT_NEAR(sum, interpolated(kind, values, in_cell(shape_of(kind), u, v, w)), 1e-12)
          << kind_name(kind);
    }
  }
}

// Values close to the bounds are found at random points: the bounds are not wide for nothing.
TEST(InterpolantRange, BoundsHoldAndAreNotFarOff) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const CellKind kind : all_kinds())
    for (int cell = 0; cell < 20; ++cell) {
      const auto values = random_values(kind, random);
      const ValueRange range = interpolant_range(kind, values);
      double least = 1e9, most = -1e9;
      for (int trial = 0; trial < 300; ++trial) {
        const double value = interpolated(
            kind, values, in_cell(shape_of(kind), unit(random), unit(random), unit(random)));
        least = std::min(least, value);
        most = std::max(most, value);
      }
      ASSERT_LE(range.least, least) << kind_name(kind);
      ASSERT_GE(range.most, most) << kind_name(kind);
      EXPECT_LE(range.most - range.least, 25 * (most - least)) << kind_name(kind);
    }
}

// A quadratic that overshoots its nodes.
TEST(InterpolantRange, OvershootIsSeen) {
  std::vector<double> values(node_count(CellKind::tetrahedron10), 0);
  values[4] = 1;  // between corners 0 and 1
  EXPECT_GE(interpolant_range(CellKind::tetrahedron10, values).most, 1);
  values[0] = 0.9;  // the greatest value lies between the two nodes
  EXPECT_GT(interpolant_range(CellKind::tetrahedron10, values).most, 1.07);
}

TEST(InterpolantRange, ConstantsAndLinearKindsAreExact) {
  std::mt19937_64 random(3);
  for (const CellKind kind : all_kinds()) {
    const std::vector<double> constant(node_count(kind), 1e300 / 3);
    EXPECT_EQ(interpolant_range(kind, constant).least, constant[0]);
    EXPECT_EQ(interpolant_range(kind, constant).most, constant[0]);
    if (order_of(kind) != CellOrder::linear) continue;
    const auto values = random_values(kind, random);
    const auto nodal = std::ranges::minmax(values);
    EXPECT_EQ(interpolant_range(kind, values).least, nodal.min);
    EXPECT_EQ(interpolant_range(kind, values).most, nodal.max);
  }
}

// A small variation of large numbers.
TEST(InterpolantRange, LargeOffsetsCostNoMoreThanTheirRounding) {
  std::vector<double> values(node_count(CellKind::brick32), 1e8);
  values[5] = 1e8 + 1e-6;
  const ValueRange range = interpolant_range(CellKind::brick32, values);
  EXPECT_LE(range.most - range.least, 1e-4);
}

}  // namespace
}  // namespace hiac
