#include "hiac/check/repair.hpp"

#include <gtest/gtest.h>

#include "hiac/check/cells.hpp"
#include "hiac/check/numbers.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/check/findings.hpp"
#include "tests/order/hard_meshes.hpp"

namespace hiac::test {
namespace {

// A kind's mirrored numbering of its mirrored reference cell is an affine image of the reference
// cell: the map of a right-handed cell with straight edges, node by node.
TEST(Repair, MirroredNumbersAreThoseOfTheMirrorImage) {
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    const auto at = reference_nodes(kind);
    const auto order = mirrored_order(kind);
    const std::size_t count = node_count(kind);
    for (std::size_t n = 0; n < count; ++n) EXPECT_EQ(order[order[n]], n);
    // the nodes of the corners' map at every reference node are the renumbered cell's own
    const auto linear = kind_of(shape_of(kind), CellOrder::linear);
    for (std::size_t n = 0; n < count; ++n) {
      std::array<double, kMaxNodesPerCell> values{};
      shape_functions<double>(linear, at[n], values);
      for (std::size_t c = 0; c < 3; ++c) {
        double x = 0;
        for (std::size_t i = 0; i < corner_count(kind); ++i) x += values[i] * at[order[i]][c];
        EXPECT_NEAR(x, at[order[n]][c], 1e-12) << kind_name(kind) << " " << n;
      }
    }
    std::vector<Position> places(at.begin(), at.end());
    Cell cell{kind, {order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count)}};
    EXPECT_EQ(judge_cells(make_mesh(places, {cell}), 0).turns[0], Turn::left) << kind_name(kind);
  }
}

TEST(Repair, LeftHandedCellsAreTurned) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids}) {
    const ZooMesh mesh = inverted(structured(2, cut), [](CellId c) { return c % 2 == 0; });
    const Repaired repaired = repair(mesh);
    EXPECT_EQ(repaired.counts.reoriented_cells, (mesh.cell_count() + 1) / 2);
    EXPECT_TRUE(judge_cells(repaired.mesh, 0).findings.empty());
    EXPECT_TRUE(repair(repaired.mesh).counts.nothing());
  }
}

TEST(Repair, ValuesFollowTheirCells) {
  ZooMesh mesh =
      make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}},
                {{CellKind::tetrahedron4, {0, 1, 2, 4}}, {CellKind::tetrahedron4, {0, 2, 1, 3}}});
  mesh.fields.push_back({"c", "", FieldLocation::cell, 2, std::vector<double>{1, 2, 3, 4}});
  mesh.fields.push_back(
      {"k", "", FieldLocation::corner, 1, std::vector<double>{0, 1, 2, 4, 0, 2, 1, 3}});
  const Repaired repaired = repair(mesh);
  EXPECT_EQ(repaired.counts.dropped_cells, 1U);
  EXPECT_EQ(repaired.counts.reoriented_cells, 1U);
  const auto& fields = repaired.mesh.fields;
  ASSERT_EQ(repaired.mesh.cell_count(), 1U);
  EXPECT_TRUE(std::ranges::equal(fields[0].values, std::vector<double>{3, 4}));
  // a corner's value was its node's number
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(fields[1].values[i], static_cast<double>(repaired.mesh.nodes[i]));
  validate(repaired.mesh, "repaired");
}

TEST(Repair, NodesAreMergedWhereTheirValuesAreTheSame) {
  const ZooMesh whole = structured(4, Cut::bricks);
  ZooMesh mesh = torn(whole, -1);
  EXPECT_EQ(repair(mesh).counts.merged_nodes, 25U);
  EXPECT_TRUE(std::ranges::equal(repair(mesh).mesh.kinds, whole.kinds));
  EXPECT_EQ(count_of(judge_nodes(repair(mesh).mesh), Defect::unused_node), 25U);
  std::vector<double> values(mesh.node_count());
  for (std::size_t n = 0; n < values.size(); ++n)
    values[n] = mesh.xyz[3 * n + 2] > 0.4 ? static_cast<double>(n) : 0;
  mesh.fields.push_back({"f", "", FieldLocation::node, 1, std::move(values)});
  EXPECT_EQ(repair(mesh).counts.merged_nodes, 10U);
  EXPECT_EQ(repair(mesh).counts.unmerged_nodes, 15U);
}

// Nodes whose values are the same in some components alone are not merged, whichever these are.
TEST(Repair, AllComponentsCountWhereNodesAreMerged) {
  const ZooMesh mesh = torn(structured(4, Cut::bricks), -1);
  for (std::size_t other = 0; other < 4; ++other) {
    std::vector<double> values(3 * mesh.node_count(), 0.5);
    if (other < 3)
      for (std::size_t n = 0; n < mesh.node_count(); ++n)
        values[3 * n + other] = static_cast<double>(n);
    ZooMesh with = mesh;
    with.fields.push_back({"v", "", FieldLocation::node, 3, std::vector<double>(values)});
    const Repaired repaired = repair(with);
    EXPECT_EQ(repaired.counts.merged_nodes, other < 3 ? 0U : 25U) << other;
    EXPECT_EQ(repaired.counts.unmerged_nodes, other < 3 ? 25U : 0U) << other;
    EXPECT_TRUE(std::ranges::equal(repaired.mesh.fields.at(0).values, values)) << other;
  }
}

// Two nodes of one cell at one place: merging them would make another kind of it.
TEST(Repair, NodesOfOneCellStayApart) {
  const ZooMesh mesh =
      make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}, {1, 1, 0}},
                {{CellKind::pyramid5, {0, 1, 2, 3, 4}}, {CellKind::tetrahedron4, {0, 2, 5, 4}}});
  const Repaired repaired = repair(mesh);
  EXPECT_EQ(repaired.counts.merged_nodes, 0U);
  EXPECT_EQ(repaired.counts.unmerged_nodes, 1U);
  EXPECT_EQ(repaired.counts.dropped_cells, 1U);
}

}  // namespace
}  // namespace hiac::test
