#include "hiac/order/gaps/gap_relation.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/order/visibility_order.hpp"
#include "tests/order/exact_relation.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/ray_order.hpp"

namespace hiac {
namespace {

using test::Cut;
using test::Position;

constexpr double kPlanarity = 1e-10;

struct NamedView {
  std::string name;
  View view;
};

// Eyes outside, inside, on a vertex, in the planes of the unit cube's sides, and far away.
std::vector<NamedView> views_of(const ZooMesh& mesh) {
  const auto vertex = mesh.position(mesh.cell_nodes(0)[1]);
  std::vector<NamedView> views{{"outside", {true, {3.1, 2.3, 2.7}, {}}},
                               {"inside", {true, {0.43, 0.52, 0.61}, {}}},
                               {"vertex", {true, {vertex[0], vertex[1], vertex[2]}, {}}},
                               {"side plane", {true, {1.0, 3.0, 0.25}, {}}},
                               {"corner line", {true, {1.0, 2.0, 1.0}, {}}},
                               {"parallel", {false, {}, {-2.6, -1.8, -2.2}}}};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      View view{false, {}, {}};
      view.direction[axis] = sign;
      views.push_back({"axis " + std::to_string(axis), view});
    }
  return views;
}

// No ray meets cells out of order, and no two cells share a group.
void expect_exact(const ZooMesh& mesh, const std::string& what, bool may_group = false) {
  const FaceAdjacency adjacency = build_face_adjacency(mesh);
  std::uint64_t seed = 1;
  for (const auto& [name, view] : views_of(mesh)) {
    const OrderResult result = exact_order(mesh, adjacency, view, kPlanarity);
    ASSERT_EQ(result.order.cells.size(), mesh.cell_count());
    EXPECT_TRUE(may_group || result.order.groups.empty()) << what << ", " << name;
    const auto check = test::check_along_rays(mesh, result.order, view, 120, seed++);
    EXPECT_GT(check.pairs, 30U) << what << ", " << name;
    EXPECT_EQ(check.misordered, 0U) << what << ", " << name;
  }
}

double distance_from_center(const Position& p) {
  return std::hypot(p[0] - 0.5, p[1] - 0.5, p[2] - 0.5);
}

TEST(GapRelation, CavitiesAreSeenThrough) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    expect_exact(
        test::keep_cells(test::random_delaunay(60, seed),
                         [](const Position& p, CellId) { return distance_from_center(p) > 0.25; }),
        "cavity");
}

TEST(GapRelation, TunnelsAndNotchesAreSeenThrough) {
  expect_exact(test::keep_cells(test::random_delaunay(80, 4),
                                [](const Position& p, CellId) {
                                  return std::hypot(p[0] - 0.5, p[1] - 0.5) > 0.2;
                                }),
               "tunnel");
  expect_exact(test::keep_cells(test::structured(4, Cut::tetrahedra),
                                [](const Position& p, CellId) { return p[0] < 0.5 || p[1] < 0.5; }),
               "notch");
}

TEST(GapRelation, SpongesAndSplintersAreSeenThrough) {
  expect_exact(test::keep_cells(test::random_delaunay(60, 5),
                                [](const Position&, CellId cell) { return cell % 3 != 0; }),
               "sponge");
  expect_exact(test::keep_cells(test::structured(3, Cut::tetrahedra),
                                [](const Position&, CellId cell) { return cell % 2 == 0; }),
               "splinters");
}

// Blocks that touch on a plane where their faces do not match: a sliding interface, and hanging
// nodes of a block refined twice as finely as its neighbour.
TEST(GapRelation, FacesThatTouchWithoutMatchingAreCrossed) {
  for (const std::size_t finer : {3U, 4U, 6U}) {
    const ZooMesh left = test::structured(3, Cut::tetrahedra);
    const ZooMesh right =
        test::moved(test::structured(finer, Cut::tetrahedra), [](const Position& p) -> Position {
          return {p[0] + 1, p[1], p[2]};
        });
    expect_exact(test::side_by_side(left, right), "sliding interface " + std::to_string(finer));
  }
}

// Parts nearly in touch: a gap or an overlap of a few ulps must not lose the order.
TEST(GapRelation, PartsAnUlpApartAreInOrder) {
  const ZooMesh left = test::structured(2, Cut::tetrahedra);
  for (const int ulps : {-2, -1, 1, 2}) {
    double shift = 1;
    for (int i = 0; i < std::abs(ulps); ++i) shift = std::nextafter(shift, ulps < 0 ? 0 : 2);
    const ZooMesh right =
        test::moved(test::structured(3, Cut::tetrahedra), [shift](const Position& p) -> Position {
          return {p[0] + shift, p[1], p[2]};
        });
    expect_exact(test::side_by_side(left, right), std::to_string(ulps) + " ulps", true);
  }
}

TEST(GapRelation, PartsFarApartAreInOrder) {
  ZooMesh parts = test::random_delaunay(12, 6);
  for (std::uint64_t i = 1; i < 4; ++i) {
    const double step = 1.5 * static_cast<double>(i);
    parts = test::side_by_side(
        parts, test::moved(test::random_delaunay(12, 6 + i), [step](const Position& p) -> Position {
          return {p[0] + step, p[1] + 0.4 * step, p[2] - 0.2 * step};
        }));
  }
  expect_exact(parts, "parts");
}

// Bricks with an edge of their tops and bottoms collapsed: quadrilaterals of which two corners are
// at one place. Seen along z, the lower one comes first.
TEST(GapRelation, CollapsedEdgesHideNothing) {
  const ZooMesh brick = test::moved(test::structured(1, Cut::bricks), [](const Position& p) {
    return Position{p[1] == 1 ? 0.5 : p[0], p[1], p[2]};
  });
  const ZooMesh mesh = test::side_by_side(brick, test::moved(brick, [](const Position& p) {
                                            return Position{p[0], p[1], p[2] + 1.5};
                                          }));
  const GapRelation relation = gap_relation(order_basis(mesh, build_face_adjacency(mesh)),
                                            {false, {}, {0, 0, 1}}, kPlanarity);
  ASSERT_EQ(relation.behind.size(), 1U);
  ASSERT_EQ(relation.behind_cell(0).size(), 1U);
  EXPECT_EQ(relation.behind_cell(0)[0], 1U);
}

// Two tetrahedra with a face each in the wall x = 0, which rounding tilts: seen along z, rays enter
// the front one through it and leave the other. The faces lie in one plane by any tolerance, but
// touch nowhere.
TEST(GapRelation, FacesOfOneWallDoNotTouch) {
  constexpr double kTilt = 1e-17;
  const ZooMesh mesh = test::make_mesh(
      {{kTilt, 0, 0},
       {kTilt, 1, 0},
       {0, 0.5, 1.5},
       {1, 0.5, 0.3},
       {0, 0, 1},
       {kTilt, 0, 3},
       {kTilt, 1, 3},
       {1, 0.4, 2.2}},
      {{CellKind::tetrahedron4, {0, 1, 2, 3}}, {CellKind::tetrahedron4, {4, 5, 6, 7}}});
  const GapRelation relation = gap_relation(order_basis(mesh, build_face_adjacency(mesh)),
                                            {false, {}, {0, 0, 1}}, kPlanarity);
  ASSERT_EQ(relation.behind_cell(0).size(), 1U);
  EXPECT_EQ(relation.behind_cell(1).size(), 0U);
}

// Two tetrahedra with corners on a lattice, seen along a line that no axis of a window runs along:
// where their outlines touch, rounding must not decide.
TEST(GapRelation, OfTwoTetrahedraInSpecialPosition) {
  std::mt19937_64 random(11);
  const auto number = [&](int most) {
    return static_cast<double>(random() % static_cast<unsigned>(most + 1));
  };
  std::size_t arrows = 0, none = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::vector<Position> corners;
    const Position apart{number(2), number(2), 2 + number(1)};
    const double far = trial % 2 == 0 ? 0 : 4096;
    for (int k = 0; k < 8; ++k) {
      const Position p{number(2), number(2), number(2)};
      const double shift = k < 4 ? 0 : 1;
      corners.push_back(
          {far + p[0] + shift * apart[0], p[1] + shift * apart[1], p[2] + shift * apart[2]});
    }
    const ZooMesh mesh = test::make_mesh(
        corners, {{CellKind::tetrahedron4, {0, 1, 2, 3}}, {CellKind::tetrahedron4, {4, 5, 6, 7}}});
    const std::array<View, 2> views{
        {{false, {}, {1 + number(2), number(3), 1 + number(2)}},
         {true, {far - 1 - number(3), -number(3), -1 - number(3)}, {}}}};
    for (const View& view : views) {
      const test::ExactRelation truth = test::exact_relation(mesh, view);
      if (!truth.overlapping.empty() || !truth.flat.empty()) continue;
      const GapRelation relation =
          gap_relation(order_basis(mesh, build_face_adjacency(mesh)), view, kPlanarity);
      std::size_t found = 0;
      for (const auto& [front, behind] : truth.arrows) {
        const auto to = relation.behind_cell(front);
        ASSERT_TRUE(to.size() == 1 && to[0] == behind) << trial;
        ++found;
      }
      ASSERT_EQ(relation.behind.size(), found) << trial;
      ++(found > 0 ? arrows : none);
    }
  }
  EXPECT_GT(arrows, 500U);
  EXPECT_GT(none, 500U);
}

// Three tetrahedra on one face, two of them on one side: the face is matched with none, and the
// order is that of the planes' sides.
TEST(GapRelation, OfThreeCellsOnOneFace) {
  const ZooMesh mesh = test::make_mesh(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 1}, {0.3, 0.3, -1}, {0.25, 0.3, -2}},
      {{CellKind::tetrahedron4, {0, 1, 2, 3}},
       {CellKind::tetrahedron4, {0, 2, 1, 4}},
       {CellKind::tetrahedron4, {0, 2, 1, 5}}});
  const FaceAdjacency adjacency = build_face_adjacency(mesh);
  for (const CellId neighbor : adjacency.neighbors) EXPECT_EQ(neighbor, kNoCell);
  const OrderBasis basis = order_basis(mesh, adjacency);
  EXPECT_EQ(basis.unmatched.size(), 12U);
  for (const double sign : {-1.0, 1.0}) {
    const View view{false, {}, {0.1, 0.05, sign}};
    const VisibilityOrder order = exact_order(basis, view, kPlanarity).order;
    // cell 0 lies above the face, the others below
    EXPECT_EQ(order.cells[sign > 0 ? 2 : 0], 0U);
  }
}

// Three slabs leaning on one another in a ring: each is in front of the next.
TEST(GapRelation, ACycleIsOneGroupOfThree) {
  const auto slab = [](double angle) {
    return test::moved(test::structured(1, Cut::tetrahedra),
                       [angle](const Position& p) -> Position {
                         const double along = 4.6 * p[0] - 2.3, across = 0.5 * p[1] + 0.75,
                                      depth = p[0] + 0.1 * p[2];
                         return {std::cos(angle) * along - std::sin(angle) * across,
                                 std::sin(angle) * along + std::cos(angle) * across, depth};
                       });
  };
  // one brick each, so that the cycle is of cells and not of their tetrahedra
  std::vector<Position> positions;
  std::vector<test::Cell> cells;
  for (int k = 0; k < 3; ++k) {
    const ZooMesh part = slab(k * 2.0943951023931953);
    test::Cell brick{CellKind::brick8, {}};
    for (const NodeId corner : {0U, 1U, 3U, 2U, 4U, 5U, 7U, 6U}) {
      brick.nodes.push_back(static_cast<NodeId>(positions.size()));
      const auto p = part.position(corner);
      positions.push_back({p[0], p[1], p[2]});
    }
    cells.push_back(brick);
  }
  const ZooMesh mesh = test::make_mesh(positions, cells);
  const OrderResult result =
      exact_order(mesh, build_face_adjacency(mesh), {false, {}, {0, 0, 1}}, kPlanarity);
  ASSERT_EQ(result.order.groups.size(), 1U);
  EXPECT_EQ(result.order.groups[0].count, 3U);
}

}  // namespace
}  // namespace hiac
