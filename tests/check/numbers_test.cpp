#include "hiac/check/numbers.hpp"

#include <gtest/gtest.h>

#include "tests/check/findings.hpp"

namespace hiac::test {
namespace {

using Offenders = std::vector<Offender>;

ZooMesh two_tetrahedra() {
  return make_mesh(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}},
      {{CellKind::tetrahedron4, {0, 1, 2, 3}}, {CellKind::tetrahedron4, {1, 2, 3, 4}}});
}

ZooMesh with_nodes(ZooMesh mesh, std::vector<NodeId> nodes) {
  mesh.nodes = std::move(nodes);
  return mesh;
}

TEST(Numbers, NodesThatAreNotThere) {
  EXPECT_TRUE(judge_numbers(two_tetrahedra()).empty());
  const auto findings = judge_numbers(with_nodes(two_tetrahedra(), {0, 1, 2, 3, 1, 2, 3, 5}));
  EXPECT_EQ(defects_of(findings), std::vector{Defect::node_index});
  EXPECT_EQ(offenders_of(findings, Defect::node_index), Offenders{{1}});
}

TEST(Numbers, CoordinatesThatAreNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const auto findings = judge_numbers(moved(two_tetrahedra(), [&](const Position& p) {
      return p[0] == 1 && p[1] == 0 ? Position{1, bad, 0} : p;
    }));
    EXPECT_EQ(defects_of(findings), std::vector{Defect::coordinate});
    EXPECT_EQ(offenders_of(findings, Defect::coordinate), Offenders{{1}});
  }
  // the nearest that is finite
  EXPECT_TRUE(judge_numbers(moved(two_tetrahedra(), [](const Position& p) {
                return Position{p[0] == 1 ? std::numeric_limits<double>::max() : p[0], p[1], p[2]};
              })).empty());
}

TEST(Numbers, NodesAtOnePlace) {
  const auto mesh = [](double z) {
    return make_mesh(
        {{0, 0, -0.0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, z}, {1, 1, 1}},
        {{CellKind::tetrahedron4, {0, 1, 2, 3}}, {CellKind::tetrahedron4, {4, 1, 2, 5}}});
  };
  const auto findings = judge_nodes(mesh(0));
  EXPECT_EQ(defects_of(findings), std::vector{Defect::duplicate_node});
  EXPECT_EQ(offenders_of(findings, Defect::duplicate_node), (Offenders{{4, 0}}));
  EXPECT_TRUE(judge_nodes(mesh(above(0))).empty());
  EXPECT_EQ(first_at_place(mesh(0)), (std::vector<NodeId>{0, 1, 2, 3, 0, 5}));
}

TEST(Numbers, NodesOfNoCellAndTwiceInACell) {
  const auto findings = judge_nodes(with_nodes(two_tetrahedra(), {0, 1, 2, 3, 0, 2, 3, 3}));
  EXPECT_EQ(defects_of(findings), (std::vector{Defect::repeated_node, Defect::unused_node}));
  EXPECT_EQ(offenders_of(findings, Defect::repeated_node), Offenders{{1}});
  EXPECT_EQ(offenders_of(findings, Defect::unused_node), Offenders{{4}});
}

// Against asking every two nodes, with many at one place.
TEST(Numbers, FirstAtPlaceIsTheLowest) {
  std::vector<Position> places;
  for (int i = 0; i < 600; ++i) places.push_back({double(i * i % 7), double(i % 3), double(i % 2)});
  const ZooMesh mesh = make_mesh(places, {});
  const auto first = first_at_place(mesh);
  for (NodeId i = 0; i < places.size(); ++i)
    EXPECT_EQ(first[i], std::ranges::find(places, places[i]) - places.begin());
}

}  // namespace
}  // namespace hiac::test
