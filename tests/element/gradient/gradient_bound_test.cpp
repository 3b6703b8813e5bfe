#include "hiac/element/gradient/gradient_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "hiac/element/gradient/curved_gradient_bound.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/interpolant_range.hpp"
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

struct Wedge {
  std::vector<Vector> nodes;
  CellField field{};
};

// A wedge with edges 0-1, 3-2 and 4-5 of these lengths along x, and a field that is `values` at
// their farther ends, 0 at the nearer ones and at the corner that is left.
Wedge wedge_with(const std::array<double, 3>& lengths, const std::array<double, 3>& values) {
  Wedge wedge;
  wedge.nodes = {{0, 0, 0}, {lengths[0], 0, 0}, {lengths[1], 1, 0}, {0, 1, 0},
                 {0, 0, 1}, {lengths[2], 0, 1}, {0, 1, 1}};
  wedge.field.values[1] = values[0];
  wedge.field.values[2] = values[1];
  wedge.field.values[5] = values[2];
  return wedge;
}

// Steepest on a grid of the wedge.
double steepest_in(const Wedge& wedge) {
  double steepest = 0;
  for (int k = 0; k <= 40; ++k)
    for (int j = 0; j <= 40; ++j)
      for (int i = 0; i <= 40; ++i) {
        const double y = 0.999 * j / 40, z = 0.999 * k / 40;
        const double x = (2 - y - z) * i / 40;
        steepest =
            std::max(steepest, gradient_at(CellKind::wedge7, wedge.nodes, wedge.field, {x, y, z}));
      }
  return steepest;
}

// By hand: the second columns are (p, 1, 0), the third ones (q, 0, 1), the first one any of the
// three edges, (l, 0, 0), with weights that sum to 1/2 at least. So the determinant is at least
// half of the least l, and the rows' numerators (1, -p, -q), (0, l, 0) and (0, 0, l).
double bound_by_hand(const std::array<double, 3>& lengths, const CellField& field) {
  const auto [l0, l1, l2] = lengths;
  const auto difference = [&](std::size_t from, std::size_t to) {
    return std::abs(field.values[to] - field.values[from]);
  };
  const double p = std::max(std::abs(l1 - l0), l2), q = std::max(std::abs(l2 - l0), l1);
  const double first = std::max({difference(0, 1), difference(3, 2), difference(4, 5)});
  const double second =
      std::max({difference(0, 3), difference(1, 2), difference(4, 6), difference(5, 6)});
  const double third =
      std::max({difference(0, 4), difference(1, 5), difference(3, 6), difference(2, 6)});
  const double numerator =
      first * std::hypot(1, p, q) + (second + third) * std::ranges::max(lengths);
  return numerator / (0.5 * std::ranges::min(lengths));
}

// The determinant is smallest where the shortest of the three edges is: a field has the gradient of
// its difference along it by its length there.
TEST(GradientBound, LooksAtAllThreeEdgesOfWedges) {
  for (std::size_t shortest = 0; shortest < 3; ++shortest)
    for (const bool alone : {true, false}) {
      std::array<double, 3> lengths{2, 2, 2}, values{0, 0, 0};
      lengths[shortest] = 0.125;
      values[shortest] = 3;
      if (!alone) values = {3, 3, 3};
      const Wedge wedge = wedge_with(lengths, values);
      const double bound = GradientBound(CellKind::wedge7, wedge.nodes)(wedge.field);
      const double by_hand = bound_by_hand(lengths, wedge.field);
      EXPECT_NEAR(bound, by_hand, 1e-12 * by_hand) << shortest;
      const double steepest = steepest_in(wedge);
      EXPECT_GE(bound, steepest) << shortest;
      EXPECT_GT(steepest, 3 / 0.125 * 0.7) << shortest;
    }
}

// All differences of neighbours count, wherever they are.
TEST(GradientBound, LooksAtAllDifferencesOfWedges) {
  constexpr std::array<double, 3> kLengths{2, 1, 1.5};
  const std::vector<Vector> nodes = wedge_with(kLengths, {}).nodes;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    Wedge wedge{nodes, {}};
    wedge.field.values[k] = 1;
    const double bound = GradientBound(CellKind::wedge7, nodes)(wedge.field);
    const double by_hand = bound_by_hand(kLengths, wedge.field);
    EXPECT_NEAR(bound, by_hand, 1e-12 * by_hand) << k;
    EXPECT_GE(bound, steepest_in(wedge)) << k;
  }
}

// Edges of lengths 1, 1 and 1 or sqrt(2) and a volume of 64 u: 32 u times the product of the
// lengths less, and rows whose cross products are wrong by 8 u times theirs.
TEST(GradientBound, AllowsForRoundingOfFlatTetrahedra) {
  constexpr double u = 0x1p-53, kHeight = 64 * u;
  const auto bound = [](const std::vector<Vector>& nodes, std::size_t k) {
    CellField field{};
    field.values[k] = 1;
    return GradientBound(CellKind::tetrahedron4, nodes)(field);
  };
  const std::vector<Vector> flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, kHeight}};
  const double expected = 1 / (kHeight - 32 * u * std::sqrt(2));
  EXPECT_NEAR(bound(flat, 1), expected, 1e-12 * expected);
  // the second edge and the third one nearly parallel: of an area of 64 u and 8 u
  const std::vector<Vector> narrow{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, kHeight}};
  EXPECT_NEAR(bound(narrow, 1), (64.0 + 8) / (64 - 32), 1e-12);
  const std::vector<Vector> flatter{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, kHeight / 2}};
  EXPECT_EQ(bound(flatter, 1), std::numeric_limits<double>::infinity());
}

// A straight ten-node tetrahedron of height h over the unit triangle, sheared so that coordinates
// differ by up to 1/2 from coefficient to coefficient. Its determinant is h / 8 times (1 - v) (1 -
// w)^2, of degree 5 in v and w, where the coefficients with v = 4/5, w = 3/5 are the smallest ones
// that do not vanish: 1 / (binomial(5, 4) binomial(5, 3)). Rounding decides about that one.
TEST(GradientBound, AllowsForRoundingOfFlatCurvedTetrahedra) {
  constexpr double u = 0x1p-53;
  constexpr CellKind kKind = CellKind::tetrahedron10;
  const auto nodes_of = [](double height) {
    std::vector<Vector> nodes;
    for (const auto& r : reference_nodes(kKind))
      nodes.push_back({r[0], r[1], r[0] + r[1] + height * r[2]});
    return nodes;
  };
  const auto bound = [&](double height) {
    CellField field{};
    std::size_t k = 0;
    for (const auto& r : reference_nodes(kKind)) field.values[k++] = r[2];
    return curved_gradient_bound(kKind, nodes_of(height), field.values);
  };
  EXPECT_NEAR(bound(1), std::sqrt(3.0), 1e-9);
  double rounding = 0;  // of the coefficients of all three coordinates
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> values;
    for (const Vector& p : nodes_of(0)) values.push_back(p[c]);
    rounding += interpolant_coefficients(kKind, values).rounding;
  }
  // The bound counts each of the determinant's six products twice, with one of its three
  // differences off by the rounding of two coefficients and by 8 units of 1/2, and once for its own
  // rounding of 512 units.
  const double off = 12 * (2 * rounding + 3 * 8 * u / 2) / 4 + 6 * 512 * u / 8;
  const double least = 8 * 5 * 10 * off;
  EXPECT_EQ(bound(0.99 * least), std::numeric_limits<double>::infinity());
  EXPECT_LT(bound(1.01 * least), std::numeric_limits<double>::infinity());
  EXPECT_GE(bound(1.01 * least) * 1.01 * least, std::sqrt(3.0));
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
