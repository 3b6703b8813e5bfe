#include "hiac/order/behind_relation.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/geometry/predicates.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "tests/order/order_meshes.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac::test {
namespace {

constexpr double kPlanarity = 1e-10;
using Real = long double;
using Vec = std::array<Real, 3>;

BehindRelation relation_of(const ZooMesh& mesh, const View& view, double planarity = kPlanarity) {
  return shared_face_relation(order_basis(mesh, build_face_adjacency(mesh)), view, planarity);
}

// Arrows between the two cells of a mesh, as seen from cell 0.
unsigned arrows_between(const ZooMesh& mesh, const View& view, double planarity = kPlanarity) {
  const BehindRelation relation = relation_of(mesh, view, planarity);
  unsigned arrows = 0;
  for (std::size_t f = 0; f < face_count(mesh.kinds[0]); ++f)
    arrows |= relation.of_cell[0].across(f);
  return arrows;
}

// Two bricks side by side along x; the square between them has its corners moved along x.
ZooMesh two_bricks(const std::array<double, 4>& moves) {
  std::vector<Position> positions;
  for (const double x : {0.0, 1.0, 2.0})
    for (const auto& [y, z] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
      positions.push_back({x, y, z});
  for (std::size_t k = 0; k < 4; ++k) positions[4 + k][0] += moves[k];
  return make_mesh(positions, {{CellKind::brick8, {0, 1, 2, 3, 4, 5, 6, 7}},
                               {CellKind::brick8, {4, 5, 6, 7, 8, 9, 10, 11}}});
}

TEST(BehindRelation, TheCellOnTheEyesSideComesFirst) {
  const ZooMesh mesh = two_bricks({});
  EXPECT_EQ(arrows_between(mesh, from_eye("", {-3, 0.5, 0.5}).view), kCellFirst);
  EXPECT_EQ(arrows_between(mesh, from_eye("", {5, 0.5, 0.5}).view), kNeighborFirst);
  EXPECT_EQ(arrows_between(mesh, from_eye("", {0.9999, 0.5, 0.5}).view), kCellFirst);
  EXPECT_EQ(arrows_between(mesh, along("", {1e-300, 1, 1}).view), kCellFirst);
  EXPECT_EQ(arrows_between(mesh, along("", {-1e-300, 1, 1}).view), kNeighborFirst);
}

TEST(BehindRelation, NoRayCrossesAFaceSeenEdgeOn) {
  const ZooMesh mesh = two_bricks({});
  EXPECT_EQ(arrows_between(mesh, from_eye("", {1, 7, 3}).view), kNoArrow);
  EXPECT_EQ(arrows_between(mesh, along("", {0, 1, 3}).view), kNoArrow);
}

TEST(BehindRelation, WarpedFaces) {
  const ZooMesh mesh = two_bricks({0.1, -0.1, 0.1, -0.1});
  EXPECT_EQ(arrows_between(mesh, from_eye("", {-3, 0.5, 0.5}).view), kCellFirst);
  EXPECT_EQ(arrows_between(mesh, from_eye("", {1, 3, 0.5}).view), kBothWays);
  EXPECT_EQ(arrows_between(mesh, along("", {0.01, 1, 0}).view), kBothWays);
  EXPECT_EQ(relation_of(mesh, along("", {0.01, 1, 0}).view).both_ways, 1U);
  EXPECT_EQ(arrows_between(mesh, along("", {1, 0.1, 0}).view), kCellFirst);
}

TEST(BehindRelation, APlanarityThatIsCoarseEnoughMakesAFacePlanar) {
  const double ulps = 1e-12;
  const ZooMesh mesh = two_bricks({ulps, -ulps, ulps, -ulps});
  const View edge_on = along("", {0, 1, 0}).view;
  EXPECT_EQ(arrows_between(mesh, edge_on, 0), kBothWays);
  EXPECT_EQ(arrows_between(mesh, edge_on), kNoArrow);
}

TEST(BehindRelation, DeviationIsTheDistanceOfTheDiagonals) {
  const Position a{0, 0, 0}, b{1, 0, 0.1}, c{1, 1, 0}, d{0, 1, 0.1};
  EXPECT_NEAR(quadrilateral_deviation(a, b, c, d), 0.1 / std::sqrt(2), 1e-15);
  EXPECT_EQ(quadrilateral_deviation(a, Position{1, 0, 0}, c, Position{0, 1, 0}), 0);
  EXPECT_EQ(quadrilateral_deviation(a, a, a, a), 0);
}

// The sign of (P - e) . (P_u x P_v) over a grid on the patch: which ways rays cross it.
struct Crossings {
  bool positive = false, negative = false;
};

Crossings crossings(const ZooMesh& mesh, std::span<const NodeId> nodes, const View& view) {
  constexpr int kSteps = 40;
  std::array<Vec, 4> p;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto position = mesh.position(nodes[k]);
    p[k] = {position[0], position[1], position[2]};
  }
  Crossings found;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const Real u = Real(i) / kSteps, v = Real(j) / kSteps;
      Vec from_eye, pu, pv;
      for (std::size_t c = 0; c < 3; ++c) {
        const Real at = (1 - u) * (1 - v) * p[0][c] + u * (1 - v) * p[1][c] + u * v * p[2][c] +
                        (1 - u) * v * p[3][c];
        from_eye[c] = view.perspective ? at - Real(view.eye[c]) : Real(view.direction[c]);
        pu[c] = (1 - v) * (p[1][c] - p[0][c]) + v * (p[2][c] - p[3][c]);
        pv[c] = (1 - u) * (p[3][c] - p[0][c]) + u * (p[2][c] - p[1][c]);
      }
      const Real d = from_eye[0] * (pu[1] * pv[2] - pu[2] * pv[1]) +
                     from_eye[1] * (pu[2] * pv[0] - pu[0] * pv[2]) +
                     from_eye[2] * (pu[0] * pv[1] - pu[1] * pv[0]);
      found.positive = found.positive || d > 1e-15L;
      found.negative = found.negative || d < -1e-15L;
    }
  return found;
}

// A patch three of whose corner triangles are seen from in front, and the one that spans its plane
// edge-on: rays cross it all the same.
TEST(BehindRelation, AWarpedFaceWithOneCornerSeenEdgeOn) {
  const ZooMesh mesh = two_bricks({0.125, 0, 0, 0});
  // the lowest node, 4, is the one that was moved; its triangle has the corners 7, 4 and 5
  const Position along_triangle{-0.25, 1, 1}, back{0.25, -1, -1};
  EXPECT_EQ(
      orientation_towards(mesh.position(7), mesh.position(4), mesh.position(5), along_triangle), 0);
  EXPECT_EQ(arrows_between(mesh, along("", along_triangle).view), kNeighborFirst);
  EXPECT_EQ(arrows_between(mesh, along("", back).view), kCellFirst);
}

// Bricks with every inner node pushed about: a face has arrows both ways exactly when rays cross
// its bilinear patch both ways.
TEST(BehindRelation, ArrowsAreTheWaysThatRaysCrossAPatch) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> push(-0.05, 0.05);
  const ZooMesh mesh = moved(structured(3, Cut::bricks), [&](const Position& p) {
    return Position{p[0] + push(random), p[1] + push(random), p[2] + push(random)};
  });
  const OrderBasis basis = order_basis(mesh, build_face_adjacency(mesh));
  std::size_t both = 0, one = 0;
  for (const auto& [name, view] : many_views()) {
    SCOPED_TRACE(name);
    const BehindRelation relation = shared_face_relation(basis, view, kPlanarity);
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
      for (std::size_t f = 0; f < 6; ++f) {
        if (basis.adjacency.neighbors[basis.faces.first(cell) + f] == kNoCell) continue;
        std::array<NodeId, 4> nodes;  // counter-clockwise seen from outside the cell
        for (std::size_t k = 0; k < 4; ++k)
          nodes[k] = mesh.cell_nodes(cell)[topology_of(CellShape::brick).faces[f].corners[k]];
        const Crossings truth = crossings(mesh, nodes, view);
        // along the outward normal rays leave the cell
        const unsigned arrows =
            (truth.positive ? kCellFirst : kNoArrow) | (truth.negative ? kNeighborFirst : kNoArrow);
        ASSERT_EQ(relation.of_cell[cell].across(f), arrows) << "cell " << cell << ", face " << f;
        ++(arrows == kBothWays ? both : one);
      }
  }
  EXPECT_GT(both, tried(100));
  EXPECT_GT(one, tried(1000));
}

// Two flat tetrahedra that share a triangle: nobody knows which is in front.
TEST(BehindRelation, CellsWithoutVolumeBesideOneAnother) {
  const ZooMesh mesh =
      make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 2, 0}},
                {{CellKind::tetrahedron4, {0, 1, 2, 3}}, {CellKind::tetrahedron4, {1, 2, 3, 4}}});
  EXPECT_EQ(arrows_between(mesh, along("", {0, 0, 1}).view), kBothWays);
  EXPECT_EQ(arrows_between(mesh, along("", {1, 2, 0}).view), kNoArrow);
}

// Two bricks of a layer without height: what they share is a line, which no ray crosses.
TEST(BehindRelation, CellsWithoutVolumeBesideOneAnotherInALayer) {
  const ZooMesh mesh = moved(two_bricks({}), [](const Position& p) {
    return Position{p[0], p[1], 0.25};
  });
  EXPECT_EQ(arrows_between(mesh, from_eye("", {-3, 0.5, 0.75}).view), kNoArrow);
}

// A stored adjacency may say anything.
TEST(BehindRelation, AnAdjacencyThatIsNotMutualIsRefused) {
  const ZooMesh mesh = structured(2, Cut::tetrahedra);
  const FaceAdjacency good = build_face_adjacency(mesh);
  std::vector<CellId> neighbors(good.neighbors.begin(), good.neighbors.end());
  const auto at = static_cast<std::size_t>(
      std::ranges::find_if(neighbors, [](CellId cell) { return cell != kNoCell; }) -
      neighbors.begin());
  for (const CellId wrong : {kNoCell, (neighbors[at] + 7) % 48, static_cast<CellId>(at / 4)}) {
    auto changed = neighbors;
    changed[at] = wrong;
    EXPECT_THROW(order_basis(mesh, {std::move(changed), 0}), InputError);
  }
}

}  // namespace
}  // namespace hiac::test
