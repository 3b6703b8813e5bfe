#include "hiac/mesh/parts/keep_cells.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

// A field of every location, whose values tell where they come from.
ZooMesh sample() {
  ZooMesh mesh = test::structured(2, test::Cut::bricks);
  test::add_counted_fields(mesh);
  mesh.metadata = {{"source", "test"}};
  return mesh;
}

TEST(KeepCells, KeepsWhatBelongsToThem) {
  const ZooMesh mesh = sample();
  std::vector<bool> keep(8, false);
  const std::vector<CellId> chosen{1, 6};
  for (const CellId cell : chosen) keep[cell] = true;
  const ZooMesh part = keep_cells(mesh, keep);
  validate(part, "part");
  ASSERT_EQ(part.cell_count(), 2U);
  EXPECT_EQ(part.node_count(), 15U);  // one node is common
  EXPECT_EQ(part.metadata, mesh.metadata);
  EXPECT_FALSE(part.adjacency.has_value());
  for (CellId cell = 0; cell < 2; ++cell) {
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(part.fields[1].values[3 * cell + c], mesh.fields[1].values[3 * chosen[cell] + c]);
    for (std::size_t k = 0; k < 8; ++k) {
      const NodeId now = part.cell_nodes(cell)[k], then = mesh.cell_nodes(chosen[cell])[k];
      for (std::size_t d = 0; d < 3; ++d) EXPECT_EQ(part.position(now)[d], mesh.position(then)[d]);
      for (std::size_t c = 0; c < 2; ++c)
        EXPECT_EQ(part.fields[0].values[2 * now + c], mesh.fields[0].values[2 * then + c]);
      EXPECT_EQ(part.fields[2].values[8 * cell + k], mesh.fields[2].values[8 * chosen[cell] + k]);
    }
  }
}

TEST(KeepCells, CellsAreJudgedByTheirOwnValues) {
  const ZooMesh mesh = test::structured(2, test::Cut::bricks);
  std::vector<double> of_cells(8), of_nodes(27, 1), of_corners(64, 1);
  for (std::size_t cell = 0; cell < 8; ++cell) of_cells[cell] = static_cast<double>(cell);
  of_nodes[mesh.nodes[8 * 3 + 6]] = 5;
  of_corners[8 * 5 + 2] = 5;
  const auto within = [&](FieldLocation location, const std::vector<double>& values, double low,
                          double high) {
    return cells_within(mesh, {"f", "", location, 1, std::vector<double>(values)}, low, high);
  };
  EXPECT_EQ(within(FieldLocation::cell, of_cells, 2, 4),
            (std::vector<bool>{false, false, true, true, true, false, false, false}));
  EXPECT_EQ(within(FieldLocation::corner, of_corners, 0, 4),
            (std::vector<bool>{true, true, true, true, true, false, true, true}));
  std::vector<bool> without_node(8, true);
  for (CellId cell = 0; cell < 8; ++cell)
    for (const NodeId node : mesh.cell_nodes(cell))
      if (node == mesh.nodes[8 * 3 + 6]) without_node[cell] = false;
  EXPECT_EQ(within(FieldLocation::node, of_nodes, 0, 4), without_node);
}

TEST(KeepCells, BoundsBelongToTheRange) {
  ZooMesh mesh = test::structured(1, test::Cut::bricks);
  const auto within = [&](FieldLocation location, std::vector<double> values, double low,
                          double high) -> bool {
    return cells_within(mesh, {"f", "", location, 1, std::move(values)}, low, high)[0];
  };
  const std::vector<double> rising{1, 2, 3, 4, 5, 6, 7, 8};
  for (const FieldLocation location : {FieldLocation::node, FieldLocation::corner}) {
    EXPECT_TRUE(within(location, rising, 1, 8));
    EXPECT_FALSE(within(location, rising, 1.5, 8));
    EXPECT_FALSE(within(location, rising, 1, 7.5));
    std::vector<double> odd = rising;
    odd[3] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(within(location, odd, 1, 8));
  }
  EXPECT_TRUE(within(FieldLocation::cell, {3}, 3, 3));
  EXPECT_FALSE(within(FieldLocation::cell, {3}, 3.5, 4));
  try {
    cells_within(mesh, {"v", "", FieldLocation::cell, 3, std::vector<double>(3)}, 0, 1);
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "field 'v' has 3 components (a scalar expected)");
  }
}

}  // namespace
}  // namespace hiac
