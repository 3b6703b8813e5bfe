#include "hiac/element/gradient_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac {
namespace {

constexpr std::array kKinds{CellKind::tetrahedron4, CellKind::pyramid5, CellKind::prism6,
                            CellKind::wedge7, CellKind::brick8};

// A point of the reference cell, at random: a mean of its corners.
Vector random_point(CellKind kind, std::mt19937_64& random) {
  std::exponential_distribution<double> weight(1);
  const auto nodes = reference_nodes(kind);
  Vector sum{};
  double all = 0;
  for (const auto& node : nodes) {
    const double w = std::pow(weight(random), 3);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += w * node[c];
    all += w;
  }
  for (double& x : sum) x /= all;
  return sum;
}

// Length of J^-T g.
double gradient_at(CellKind kind, const std::vector<Vector>& nodes, const CellField& field,
                   const Vector& xi) {
  std::array<std::array<double, 3>, kMaxNodesPerCell> shape;
  shape_gradients<double>(kind, xi, shape);
  std::array<Vector, 3> column{};
  Vector slope{};
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (std::size_t a = 0; a < 3; ++a) {
      slope[a] += shape[k][a] * field.values[k];
      for (std::size_t c = 0; c < 3; ++c) column[a][c] += shape[k][a] * nodes[k][c];
    }
  const Vector bc = cross(column[1], column[2]), ca = cross(column[2], column[0]);
  const Vector ab = cross(column[0], column[1]);
  Vector sum;
  for (std::size_t c = 0; c < 3; ++c)
    sum[c] = slope[0] * bc[c] + slope[1] * ca[c] + slope[2] * ab[c];
  return length(sum) / std::abs(dot(column[0], bc));
}

TEST(GradientBound, HoldsInDistortedCells) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::size_t shown = 0, judged = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const CellKind kind = kKinds[static_cast<std::size_t>(trial) % kKinds.size()];
    const double distortion = 0.3 * std::abs(unit(random));
    std::vector<Vector> nodes;
    CellField field{};
    field.least = 1;
    field.most = -1;
    for (const auto& node : reference_nodes(kind)) {
      Vector& p = nodes.emplace_back(node);
      for (double& x : p) x += distortion * unit(random);
      p[0] *= 0.1;
      p[1] += 0.7 * p[0] + 100;
      const double value = field.values[nodes.size() - 1] = unit(random);
      field.least = std::min(field.least, value);
      field.most = std::max(field.most, value);
    }
    const double bound = GradientBound(kind, nodes)(field);
    ++judged;
    if (!std::isfinite(bound)) continue;
    ++shown;
    double steepest = 0;
    for (int k = 0; k < 50; ++k)
      steepest = std::max(steepest, gradient_at(kind, nodes, field, random_point(kind, random)));
    ASSERT_LE(steepest, bound) << static_cast<int>(kind) << ' ' << trial;
    if (distortion < 0.03) {
      ASSERT_LE(bound, 12 * steepest) << static_cast<int>(kind) << ' ' << trial;
    }
  }
  EXPECT_GT(shown, judged * 6 / 10);
}

// Of cells of higher order with curved edges.
TEST(GradientBound, HoldsInCurvedCells) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::size_t shown = 0, judged = 0;
  const std::size_t trials = test::tried(400);
  for (std::size_t trial = 0; trial < trials; ++trial) {
    const auto kind = static_cast<CellKind>(3 * (trial % 5) + 1 + trial / 5 % 2);
    const double distortion = 0.06 * std::abs(unit(random)) / static_cast<double>(order_of(kind));
    std::vector<Vector> nodes;
    CellField field{};
    for (const auto& node : reference_nodes(kind)) {
      Vector& p = nodes.emplace_back(node);
      for (double& x : p) x += distortion * unit(random);
      p[0] *= 0.1;
      p[1] += 0.7 * p[0] + 100;
      field.values[nodes.size() - 1] = unit(random);
    }
    const double bound = GradientBound(kind, nodes)(field);
    ++judged;
    if (!std::isfinite(bound)) continue;
    ++shown;
    double steepest = 0;
    for (int k = 0; k < 200; ++k)
      steepest = std::max(steepest, gradient_at(kind, nodes, field, random_point(kind, random)));
    ASSERT_LE(steepest, bound) << kind_name(kind) << ' ' << trial;
    if (distortion < 0.005) {
      ASSERT_LE(bound, 16 * steepest) << kind_name(kind) << ' ' << trial;
    }
  }
  EXPECT_GT(shown, judged * 9 / 10);
}

// A linear field has one gradient, however the cell is curved.
TEST(GradientBound, IsSharpForLinearFields) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    if (order_of(kind) == CellOrder::linear) continue;
    std::vector<Vector> nodes;
    CellField field{};
    for (const auto& node : reference_nodes(kind)) {
      Vector& p = nodes.emplace_back(node);
      for (double& x : p) x += 0.02 * unit(random);
      field.values[nodes.size() - 1] = 3 * p[0] - 4 * p[1];
    }
    EXPECT_NEAR(GradientBound(kind, nodes)(field), 5, 1e-6) << kind_name(kind);
  }
}

TEST(GradientBound, IsInfiniteWhereCellsFold) {
  std::vector<Vector> nodes;
  for (const auto& node : reference_nodes(CellKind::brick8)) nodes.emplace_back(node);
  CellField field{};
  field.values[0] = 1;
  EXPECT_LT(GradientBound(CellKind::brick8, nodes)(field), 4);
  std::swap(nodes[0], nodes[6]);
  EXPECT_EQ(GradientBound(CellKind::brick8, nodes)(field), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace hiac
