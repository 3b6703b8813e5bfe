#include "hiac/check/conformity.hpp"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/check/findings.hpp"
#include "tests/order/hard_meshes.hpp"

namespace hiac::test {
namespace {

std::vector<Finding> judged(const ZooMesh& mesh, double planarity = 0) {
  return judge_conformity(mesh, build_face_adjacency(mesh), judge_cells(mesh, planarity),
                          planarity);
}

std::size_t found(const ZooMesh& mesh, Defect defect, double planarity = 0) {
  return count_of(judged(mesh, planarity), defect);
}

TEST(Conformity, ConformingMeshesAreFoundSo) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids}) {
    const ZooMesh mesh = structured(3, cut);
    EXPECT_TRUE(judged(mesh).empty());
    EXPECT_TRUE(judged(moved(mesh, turned), 1e-10).empty());
    EXPECT_TRUE(judged(inverted(mesh, [](CellId) { return true; })).empty());
    EXPECT_TRUE(judged(inverted(mesh, [](CellId c) { return c % 3 == 1; })).empty());
  }
  EXPECT_TRUE(judged(random_delaunay(60, 3)).empty());
}

TEST(Conformity, AnAdjacencyThatIsNotTheMeshs) {
  ZooMesh mesh = structured(2, Cut::bricks);
  mesh.adjacency = build_face_adjacency(mesh);
  EXPECT_TRUE(judged(mesh).empty());
  std::vector<CellId> neighbors(mesh.adjacency->neighbors.begin(), mesh.adjacency->neighbors.end());
  neighbors[8] = 5;
  mesh.adjacency->neighbors = std::move(neighbors);
  EXPECT_EQ(offenders_of(judged(mesh), Defect::adjacency), (std::vector<Offender>{{1, 2}}));
}

TEST(Conformity, FacesOfThreeCells) {
  const auto mesh = [](NodeId third) {
    return make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0, 0, 2}, {0, 1, 0}},
                     {{CellKind::tetrahedron4, {0, 1, 2, 3}},
                      {CellKind::tetrahedron4, {0, 2, 1, 4}},
                      {CellKind::tetrahedron4, {0, 1, third, 5}}});
  };
  EXPECT_EQ(offenders_of(judged(mesh(2)), Defect::overshared_face),
            (std::vector<Offender>{{0, 3}, {1, 3}, {2, 3}}));
  EXPECT_EQ(found(mesh(6), Defect::overshared_face), 0U);
}

// Three cells on a quadrilateral and four on a triangle of one of them, numbered in other orders
// and with cells of other kinds between them: every one of them is named, by cell and face.
TEST(Conformity, SeveralOversharedFacesOfOneCell) {
  const ZooMesh mesh = make_mesh({{0, 0, 0},
                                  {1, 0, 0},
                                  {1, 1, 0},
                                  {0, 1, 0},
                                  {0.5, 0.5, 1},
                                  {0.5, 0.5, 2},
                                  {0.5, 0.5, -1},
                                  {0.5, -1, 0.5},
                                  {0.5, -2, 0.5},
                                  {0.5, -3, 0.5}},
                                 {{CellKind::tetrahedron4, {4, 1, 0, 7}},
                                  {CellKind::pyramid5, {2, 3, 0, 1, 5}},
                                  {CellKind::tetrahedron4, {8, 0, 1, 4}},
                                  {CellKind::pyramid5, {0, 3, 2, 1, 6}},
                                  {CellKind::tetrahedron4, {0, 9, 4, 1}},
                                  {CellKind::pyramid5, {0, 1, 2, 3, 4}}});
  // by the definition: the faces of all cells whose corners three or more have
  std::map<std::set<NodeId>, std::vector<Offender>> sides;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto faces = topology_of(mesh.kinds[cell]).faces;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      std::set<NodeId> corners;
      for (std::size_t k = 0; k < faces[f].corner_count; ++k)
        corners.insert(mesh.cell_nodes(cell)[faces[f].corners[k]]);
      sides[corners].push_back({cell, f});
    }
  }
  std::vector<Offender> expected;
  for (const auto& [corners, here] : sides)
    if (here.size() > 2) expected.insert(expected.end(), here.begin(), here.end());
  std::ranges::sort(expected, {}, [](const Offender& o) { return std::pair(o.id, o.other); });
  ASSERT_EQ(expected.size(), 7U);
  EXPECT_EQ(offenders_of(judged(mesh), Defect::overshared_face), expected);
}

// The apex of a second tetrahedron on the first one's face, on either side of it.
TEST(Conformity, CellsOnOneSideOfTheirFaceByOneUlp) {
  for (const auto& motion : exact_motions())
    for (const bool renumbered : {false, true}) {
      const auto mesh = [&](double z) {
        const std::vector<NodeId> second =
            renumbered ? std::vector<NodeId>{1, 0, 2, 4} : std::vector<NodeId>{0, 1, 2, 4};
        return moved(
            make_mesh({{0, 0, 0.3}, {1, 0, 0.3}, {0, 1, 0.3}, {0, 0, 1}, {0.2, 0.2, z}},
                      {{CellKind::tetrahedron4, {0, 1, 2, 3}}, {CellKind::tetrahedron4, second}}),
            motion);
      };
      EXPECT_EQ(offenders_of(judged(mesh(above(0.3))), Defect::folded_face),
                (std::vector<Offender>{{0, 1}}));
      EXPECT_EQ(found(mesh(0.3), Defect::folded_face), 0U);  // it has no side
      EXPECT_EQ(found(mesh(below(0.3)), Defect::folded_face), 0U);
    }
}

TEST(Conformity, FourCornersInAnotherOrderAreFolded) {
  const auto mesh = [](std::vector<NodeId> base) {
    base.push_back(5);
    return make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1}},
                     {{CellKind::pyramid5, {0, 1, 2, 3, 4}}, {CellKind::pyramid5, base}});
  };
  EXPECT_EQ(found(mesh({0, 3, 2, 1}), Defect::folded_face), 0U);
  EXPECT_EQ(found(mesh({0, 1, 2, 3}), Defect::folded_face), 0U);  // numbered in the mirror
  // crossed over, the base makes no body whose side could be told: that is the cell's defect
  EXPECT_EQ(count_of(judge_cells(mesh({0, 2, 1, 3}), 0).findings, Defect::jacobian), 1U);
}

// Two bricks against another; where they meet is at y = 0.5, and at x = 1 + by.
ZooMesh bricks_against_two(double by, double split) {
  std::vector<Position> places;
  const auto add = [&](const Position& low, const Position& high) {
    const auto first = static_cast<NodeId>(places.size());
    for (const auto& at : reference_nodes(CellKind::brick8))
      places.push_back({at[0] != 0 ? high[0] : low[0], at[1] != 0 ? high[1] : low[1],
                        at[2] != 0 ? high[2] : low[2]});
    Cell cell{CellKind::brick8, {}};
    for (NodeId k = 0; k < 8; ++k) cell.nodes.push_back(first + k);
    return cell;
  };
  const double x = 1 + by;
  const std::vector<Cell> cells{add({0, 0, 0}, {1, 1, 1}), add({x, 0, 0}, {2, split, 1}),
                                add({x, split, 0}, {2, 1.25, 1})};
  return make_mesh(places, cells);
}

TEST(Conformity, InterfacesByOneUlp) {
  const double ulp = above(1) - 1;
  for (const auto& motion : exact_motions()) {
    const auto of = [&](double by, double split, double planarity = 0) {
      return judged(moved(bricks_against_two(by, split), motion), planarity);
    };
    // the middle brick's face is wholly on the great one's, the last one's in part
    EXPECT_EQ(offenders_of(of(0, 0.5), Defect::hanging_interface),
              (std::vector<Offender>{{0, 1}, {1, 0}}));
    EXPECT_EQ(offenders_of(of(0, 0.5), Defect::sliding_interface), (std::vector<Offender>{{2, 0}}));
    EXPECT_EQ(count_of(of(ulp, 0.5), Defect::hanging_interface), 0U);
    EXPECT_EQ(count_of(of(ulp, 0.5), Defect::sliding_interface), 0U);
    EXPECT_EQ(count_of(of(ulp, 0.5, 1e-10), Defect::hanging_interface), 2U);
    // as large as the great one's: torn, and the last one beside it touches but its edge
    const auto torn = of(0, 1);
    EXPECT_EQ(offenders_of(torn, Defect::torn_interface),
              (std::vector<Offender>{{0, 1}, {1, 0}, {1, 3}, {2, 2}}));
    EXPECT_EQ(count_of(torn, Defect::hanging_interface), 0U);
    EXPECT_EQ(count_of(torn, Defect::sliding_interface), 0U);
    // an ulp larger or smaller than it
    EXPECT_EQ(count_of(of(0, above(1)), Defect::hanging_interface), 2U);
    EXPECT_EQ(count_of(of(0, below(1)), Defect::sliding_interface), 1U);
  }
}

TEST(Conformity, TornMeshesAreTorn) {
  const ZooMesh mesh = torn(structured(4, Cut::bricks), -1);
  EXPECT_EQ(found(mesh, Defect::torn_interface), 32U);
  EXPECT_EQ(found(moved(mesh, turned), Defect::torn_interface, 1e-10), 32U);
}

}  // namespace
}  // namespace hiac::test
