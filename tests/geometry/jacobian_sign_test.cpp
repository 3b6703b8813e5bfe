#include "hiac/geometry/jacobian_sign.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

using Point = std::array<double, 3>;

constexpr double kTolerance = 1e-10;

std::vector<Point> nodes_of(CellKind kind) {
  const auto nodes = reference_nodes(kind);
  return {nodes.begin(), nodes.end()};
}

// Moves every node by up to `by` in every coordinate.
std::vector<Point> jiggled(CellKind kind, double by, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(-by, by);
  std::vector<Point> nodes = nodes_of(kind);
  for (Point& p : nodes)
    for (double& x : p) x += offset(random);
  return nodes;
}

double determinant(CellKind kind, const std::vector<Point>& nodes, const Point& xi) {
  std::array<Point, kMaxNodesPerCell> gradients;
  shape_gradients<double>(kind, xi, gradients);
  std::array<Point, 3> m{};
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t c = 0; c < 3; ++c) m[i][c] += gradients[k][i] * nodes[k][c];
  const auto& [a, b, c] = m;
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// A random point of the reference cell: its nodes' weighted mean.
template <typename Random>
Point inside(CellKind kind, Random& random) {
  std::exponential_distribution<double> weight;
  Point p{};
  double sum = 0;
  for (std::size_t k = 0; k < corner_count(kind); ++k) {
    const double w = std::pow(weight(random), 2);
    sum += w;
    for (std::size_t c = 0; c < 3; ++c) p[c] += w * reference_nodes(kind)[k][c];
  }
  for (double& x : p) x /= sum;
  return p;
}

// Random cells of every kind against the determinant at many points: what is said to have one sign
// has it there, and where both signs are met they are found.
TEST(JacobianSign, RandomCellsOfEveryKindAgreeWithSamples) {
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    const double most = 0.4 / static_cast<double>(order_of(kind));
    std::size_t positive = 0, mixed = 0;
    for (unsigned seed = 0; seed < 12; ++seed) {
      const auto nodes = jiggled(kind, most * (seed + 1) / 12, seed);
      const JacobianSign sign = jacobian_sign(kind, nodes, kTolerance);
      std::mt19937 random(seed);
      double least = determinant(kind, nodes, inside(kind, random)), largest = least;
      for (int i = 0; i < 500; ++i) {
        const double here = determinant(kind, nodes, inside(kind, random));
        least = std::min(least, here);
        largest = std::max(largest, here);
      }
      if (sign == JacobianSign::positive) {
        EXPECT_GT(least, 0) << kind_name(kind) << " " << seed;
        ++positive;
      } else if (sign == JacobianSign::negative) {
        EXPECT_LT(largest, 0) << kind_name(kind) << " " << seed;
      } else {
        EXPECT_TRUE(sign == JacobianSign::mixed) << kind_name(kind) << " " << seed;
        ++mixed;
      }
      EXPECT_FALSE(least < -1e-6 && largest > 1e-6 && sign != JacobianSign::mixed)
          << kind_name(kind) << " " << seed;
    }
    EXPECT_GT(positive, 0U) << kind_name(kind);
    if (kind == CellKind::tetrahedron4) continue;
    EXPECT_GT(mixed + positive, 6U) << kind_name(kind);
  }
}

TEST(JacobianSign, ReferenceCellsMirrorImagesAndFlatCells) {
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    auto nodes = nodes_of(kind);
    EXPECT_EQ(jacobian_sign(kind, nodes, kTolerance), JacobianSign::positive) << kind_name(kind);
    for (Point& p : nodes) p[1] = -p[1];
    EXPECT_EQ(jacobian_sign(kind, nodes, kTolerance), JacobianSign::negative) << kind_name(kind);
    for (Point& p : nodes) p[1] = 0.25;
    EXPECT_EQ(jacobian_sign(kind, nodes, kTolerance), JacobianSign::flat) << kind_name(kind);
  }
}

// A brick that is right at all of its corners and inside out on an edge: with x-edges (1, 0, 0),
// y-edges and z-edges turned towards each other halfway.
TEST(JacobianSign, CornersAloneDoNotDecide) {
  const std::vector<Point> nodes{{0, 0, 0},   {1, 0, 0},    {1, 1, 0}, {0, 1, 0},
                                 {0, 0.9, 1}, {1, -0.9, 1}, {1, 1, 1}, {0, 1, 1}};
  double least = 1, at_corners = 1;
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j <= 20; ++j)
      for (int l = 0; l <= 20; ++l) {
        const double here = determinant(CellKind::brick8, nodes, {i / 20.0, j / 20.0, l / 20.0});
        least = std::min(least, here);
        if (i % 20 == 0 && j % 20 == 0 && l % 20 == 0) at_corners = std::min(at_corners, here);
      }
  const JacobianSign sign = jacobian_sign(CellKind::brick8, nodes, kTolerance);
  EXPECT_EQ(sign, least < 0 ? JacobianSign::mixed : JacobianSign::positive);
  EXPECT_GT(at_corners, 0);
}

// The largest product of the lengths of the map's columns at the corners of a straight cell, of the
// cube that is collapsed to it: there (1 - z)^2 of a pyramid's, 2 - y - z of a wedge's count.
double largest_box(CellKind kind, const std::vector<Point>& nodes) {
  double largest = 0;
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; j <= 2; ++j)
      for (int l = 0; l <= 2; ++l) {
        Point xi{i / 2.0, j / 2.0, l / 2.0};
        double factor = 1;
        if (shape_of(kind) == CellShape::pyramid) {
          factor = (1 - xi[2]) * (1 - xi[2]);
          xi[0] *= 1 - xi[2], xi[1] *= 1 - xi[2];
        } else if (shape_of(kind) == CellShape::wedge) {
          factor = 2 - xi[1] - xi[2];
          xi[0] *= factor;
        }
        if (factor == 0) continue;
        std::array<Point, kMaxNodesPerCell> gradients;
        shape_gradients<double>(kind, xi, gradients);
        double box = factor;
        for (std::size_t a = 0; a < 3; ++a) {
          Point column{};
          for (std::size_t k = 0; k < nodes.size(); ++k)
            for (std::size_t c = 0; c < 3; ++c) column[c] += gradients[k][a] * nodes[k][c];
          box *= std::hypot(column[0], column[1], column[2]);
        }
        largest = std::max(largest, box);
      }
  return largest;
}

// A corner of the bottom pushed inwards until the cell is inside out there, which counts from a
// fraction of the cell's size on.
TEST(JacobianSign, ToleranceIsRelativeToTheLargestProductOfColumns) {
  for (const CellKind kind : {CellKind::pyramid5, CellKind::wedge7, CellKind::brick8})
    for (const double scale : {1.0, 1e-5, 1e7})
      for (const bool mirrored : {false, true}) {
        auto nodes = nodes_of(kind);
        for (Point& p : nodes) p = {3 * p[0], p[1], 0.5 * p[2]};
        nodes[0][0] += 0.52 * nodes[1][0];
        nodes[0][1] += 0.52;
        for (Point& p : nodes)
          for (std::size_t c = 0; c < 3; ++c) p[c] *= mirrored && c == 2 ? -scale : scale;
        const double factor = shape_of(kind) == CellShape::wedge ? 2 : 1;
        const double corner = factor * determinant(kind, nodes, {0, 0, 0});
        const double fraction = std::abs(corner) / largest_box(kind, nodes);
        EXPECT_GT(fraction, 0.001);
        EXPECT_EQ(jacobian_sign(kind, nodes, 0.99 * fraction), JacobianSign::mixed)
            << kind_name(kind);
        EXPECT_EQ(jacobian_sign(kind, nodes, 1.01 * fraction),
                  mirrored ? JacobianSign::negative : JacobianSign::positive)
            << kind_name(kind);
      }
}

}  // namespace
}  // namespace hiac
