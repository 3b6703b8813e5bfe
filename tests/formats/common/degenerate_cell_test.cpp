#include "formats/common/cells/degenerate_cell.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/shape_functions.hpp"

namespace hiac::formats {
namespace {

using Nodes = std::vector<NodeId>;
using Permutation = std::array<std::size_t, 8>;

/// The symmetries of the brick as permutations of its corners: 24 rotations, 24 reflections.
std::vector<Permutation> brick_symmetries() {
  std::vector<Permutation> result;
  const auto corners = reference_nodes(CellKind::brick8);
  std::array<std::size_t, 3> axes{0, 1, 2};
  do {
    for (unsigned flips = 0; flips < 8; ++flips) {
      Permutation permutation{};
      for (std::size_t i = 0; i < 8; ++i) {
        std::array<double, 3> image{};
        for (std::size_t c = 0; c < 3; ++c)
          image[c] = (flips >> c & 1U) != 0 ? 1 - corners[i][axes[c]] : corners[i][axes[c]];
        permutation[i] = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), image) -
                                                  corners.begin());
      }
      result.push_back(permutation);
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return result;
}

using Vector = std::array<double, 3>;

double triple(const Vector& a, const Vector& b, const Vector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Volume enclosed by a cell's faces, positive when they turn counter-clockwise seen from outside.
/// A quadrilateral counts as the mean of its two triangulations, which is what a bilinear patch
/// encloses.
double volume(CellKind kind, const Nodes& nodes, const std::vector<Vector>& points) {
  double sum = 0;
  for (const ShapeFace& face : topology_of(kind).faces) {
    const std::size_t n = face.corner_count;
    const auto corner = [&](std::size_t i) { return points[nodes[face.corners[i % n]]]; };
    for (std::size_t i = 0; i < n; ++i)
      sum += triple(corner(i), corner(i + 1), corner(i + 2)) / (n == 3 ? 3 : 2);
  }
  return sum / 6;
}

Nodes true_nodes(const TrueCell& cell, const Nodes& nodes) {
  Nodes result;
  for (std::size_t i = 0; i < node_count(cell.kind); ++i) result.push_back(nodes[cell.nodes[i]]);
  return result;
}

struct Case {
  const char* name;
  Nodes nodes;  ///< of the brick, in its standard position
  CellKind kind;
};

// how solvers write them
const std::array<Case, 6> kCases{{
    {"edge", {0, 1, 2, 3, 4, 5, 6, 6}, CellKind::wedge7},
    {"two parallel edges of a face", {0, 1, 2, 2, 4, 5, 6, 6}, CellKind::prism6},
    {"face", {0, 1, 2, 3, 4, 4, 4, 4}, CellKind::pyramid5},
    {"face and an edge", {0, 1, 2, 2, 4, 4, 4, 4}, CellKind::tetrahedron4},
    {"prism with a side edge collapsed", {0, 1, 2, 2, 0, 5, 6, 6}, CellKind::pyramid5},
    {"nothing", {0, 1, 2, 3, 4, 5, 6, 7}, CellKind::brick8},
}};

TEST(TrueKinds, EveryPositionOfEveryCollapseIsFound) {
  TrueKinds kinds;
  for (const Case& c : kCases) {
    std::vector<Vector> points(reference_nodes(CellKind::brick8).begin(),
                               reference_nodes(CellKind::brick8).end());
    const double straight = volume(CellKind::brick8, c.nodes, points);
    for (const Permutation& symmetry : brick_symmetries()) {
      Nodes nodes(8);
      for (std::size_t i = 0; i < 8; ++i) nodes[i] = c.nodes[symmetry[i]];
      const TrueCell found = kinds.find(CellKind::brick8, nodes);
      ASSERT_EQ(found.problem, "") << c.name;
      ASSERT_EQ(found.kind, c.kind) << c.name;
      // the same solid, the same way round: a reflected brick gives a reflected cell
      const Nodes as_true = true_nodes(found, nodes);
      EXPECT_NEAR(volume(found.kind, as_true, points), volume(CellKind::brick8, nodes, points),
                  1e-14)
          << c.name;
      EXPECT_NEAR(std::abs(volume(found.kind, as_true, points)), straight, 1e-14) << c.name;
    }
  }
}

TEST(TrueKinds, ACellInItsOwnOrderKeepsIt) {
  TrueKinds kinds;
  const Nodes wedge{10, 11, 12, 13, 14, 15, 16, 16};
  const TrueCell found = kinds.find(CellKind::brick8, wedge);
  EXPECT_EQ(true_nodes(found, wedge), (Nodes{10, 11, 12, 13, 14, 15, 16}));
}

// The interpolant of the collapsed brick is that of the true kind: checked where both are known,
// at the images of random points of the brick.
TEST(TrueKinds, TheInterpolantStays) {
  TrueKinds kinds;
  unsigned seed = 1;
  const auto random = [&] { return (seed = seed * 1664525U + 1013904223U) / 4294967296.0; };
  for (const Case& c : kCases) {
    if (c.kind == CellKind::wedge7 || c.kind == CellKind::brick8) continue;
    const TrueCell found = kinds.find(CellKind::brick8, c.nodes);
    const Nodes nodes = true_nodes(found, c.nodes);
    // node positions: those of the true kind's reference cell, and a field with random values
    std::vector<Vector> points(8);
    std::vector<double> values(8);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      points[nodes[i]] = reference_nodes(found.kind)[i];
    for (double& value : values) value = random();
    for (int trial = 0; trial < 20; ++trial) {
      const Vector xi{random(), random(), random()};
      std::array<double, 8> brick{};
      shape_functions<double>(CellKind::brick8, xi, brick);
      Vector x{};
      double expected = 0;
      for (std::size_t i = 0; i < 8; ++i) {
        expected += brick[i] * values[c.nodes[i]];
        for (std::size_t k = 0; k < 3; ++k) x[k] += brick[i] * points[c.nodes[i]][k];
      }
      std::array<double, 8> shape{};
      shape_functions<double>(found.kind, x, shape);
      double value = 0;
      for (std::size_t i = 0; i < nodes.size(); ++i) value += shape[i] * values[nodes[i]];
      EXPECT_NEAR(value, expected, 1e-13) << c.name;
    }
  }
}

TEST(TrueKinds, TheKnifeIsRefusedByName) {
  TrueKinds kinds;
  const TrueCell knife = kinds.find(CellKind::brick8, Nodes{0, 1, 0, 3, 4, 5, 6, 7});
  EXPECT_NE(knife.problem.find("knife"), std::string_view::npos);
}

TEST(TrueKinds, OtherRepetitionsAreRefused) {
  TrueKinds kinds;
  for (const Nodes& nodes :
       {Nodes{0, 0, 0, 3, 4, 5, 6, 7}, Nodes{0, 0, 2, 3, 4, 5, 6, 6}, Nodes{0, 0, 0, 0, 0, 0, 0, 0},
        Nodes{0, 0, 0, 0, 4, 4, 4, 4}, Nodes{0, 1, 2, 3, 0, 1, 2, 3}})
    EXPECT_FALSE(kinds.find(CellKind::brick8, nodes).problem.empty());
}

TEST(TrueKinds, OtherShapesCollapseToo) {
  TrueKinds kinds;
  const TrueCell prism = kinds.find(CellKind::prism6, Nodes{0, 1, 2, 0, 4, 5});
  EXPECT_EQ(prism.problem, "");
  EXPECT_EQ(prism.kind, CellKind::pyramid5);
  const TrueCell pyramid = kinds.find(CellKind::pyramid5, Nodes{0, 1, 2, 2, 4});
  EXPECT_EQ(pyramid.problem, "");
  EXPECT_EQ(pyramid.kind, CellKind::tetrahedron4);
  const TrueCell prism_to_tetrahedron = kinds.find(CellKind::prism6, Nodes{0, 1, 2, 3, 3, 3});
  EXPECT_EQ(prism_to_tetrahedron.kind, CellKind::tetrahedron4);
  EXPECT_FALSE(kinds.find(CellKind::tetrahedron4, Nodes{0, 1, 2, 2}).problem.empty());
}

// A 20-node brick as Ansys writes a 15-node prism: the mid-edge nodes of collapsed edges are the
// corners', those of edges that fell together are one.
TEST(TrueKinds, QuadraticBricksTakeTheirMidEdgeNodesAlong) {
  TrueKinds kinds;
  //                 corners                  0-1 1-2 2-3 3-0 4-5 5-6 6-7 7-4 0-4 1-5 2-6 3-7
  const Nodes prism{0, 1, 2, 2, 4, 5, 6, 6, 8, 9, 2, 11, 12, 13, 6, 15, 16, 17, 18, 18};
  const TrueCell found = kinds.find(CellKind::brick20, prism);
  ASSERT_EQ(found.problem, "");
  ASSERT_EQ(found.kind, CellKind::prism15);
  const Nodes nodes = true_nodes(found, prism);
  const auto edges = topology_of(CellShape::prism).edges;
  const auto brick_edges = topology_of(CellShape::brick).edges;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    // the mid-edge node belongs to a brick edge between the same nodes
    const NodeId mid = nodes[6 + e];
    const auto source = std::find(prism.begin() + 8, prism.end(), mid) - prism.begin() - 8;
    const ShapeEdge edge = brick_edges[static_cast<std::size_t>(source)];
    const std::array<NodeId, 2> ends{nodes[edges[e][0]], nodes[edges[e][1]]};
    const std::array<NodeId, 2> expected{prism[edge[0]], prism[edge[1]]};
    EXPECT_TRUE(std::is_permutation(ends.begin(), ends.end(), expected.begin())) << e;
  }
  Nodes torn = prism;
  torn[19] = 19;  // edges 2-6 and 3-7 are one edge now, with two middles
  EXPECT_FALSE(kinds.find(CellKind::brick20, torn).problem.empty());
  torn = prism;
  torn[10] = 10;  // a middle of the collapsed edge 2-3 that is not its corner
  EXPECT_FALSE(kinds.find(CellKind::brick20, torn).problem.empty());
}

}  // namespace
}  // namespace hiac::formats
