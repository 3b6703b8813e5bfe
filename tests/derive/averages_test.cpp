#include "hiac/derive/averages.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

std::vector<double> random_values(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<double> values(count);
  for (double& v : values) v = value(random);
  return values;
}

// Cell by cell for every node: what a cell's value adds to a node's.
TEST(Averages, AreMeansOverWhatHolds) {
  const ZooMesh mesh = test::structured(3, test::Cut::bricks);
  const Field of_cells{"c", "K", FieldLocation::cell, 2, random_values(2 * mesh.cell_count(), 1)};
  const Field of_corners{"k", "K", FieldLocation::corner, 2,
                         random_values(2 * mesh.nodes.size(), 2)};
  const Field of_nodes{"n", "K", FieldLocation::node, 2, random_values(2 * mesh.node_count(), 3)};
  const Field cells_at_nodes = node_average(mesh, of_cells);
  const Field corners_at_nodes = node_average(mesh, of_corners);
  EXPECT_EQ(cells_at_nodes.unit, "K");
  EXPECT_EQ(cells_at_nodes.location, FieldLocation::node);
  for (NodeId node = 0; node < mesh.node_count(); ++node)
    for (std::size_t c = 0; c < 2; ++c) {
      double from_cells = 0, from_corners = 0, count = 0;
      for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
        for (std::size_t k = 0; k < 8; ++k) {
          if (mesh.cell_nodes(cell)[k] != node) continue;
          from_cells += of_cells.values[2 * cell + c];
          from_corners += of_corners.values[2 * (8 * cell + k) + c];
          ++count;
        }
      EXPECT_NEAR(cells_at_nodes.values[2 * node + c], from_cells / count, 1e-15);
      EXPECT_NEAR(corners_at_nodes.values[2 * node + c], from_corners / count, 1e-15);
    }
  const Field nodes_at_cells = cell_average(mesh, of_nodes);
  const Field corners_at_cells = cell_average(mesh, of_corners);
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    for (std::size_t c = 0; c < 2; ++c) {
      double from_nodes = 0, from_corners = 0;
      for (std::size_t k = 0; k < 8; ++k) {
        from_nodes += of_nodes.values[2 * mesh.cell_nodes(cell)[k] + c] / 8;
        from_corners += of_corners.values[2 * (8 * cell + k) + c] / 8;
      }
      EXPECT_NEAR(nodes_at_cells.values[2 * cell + c], from_nodes, 1e-15);
      EXPECT_NEAR(corners_at_cells.values[2 * cell + c], from_corners, 1e-15);
    }
}

TEST(Averages, OfWhatIsThereAlreadyAreRefused) {
  const ZooMesh mesh = test::structured(1, test::Cut::bricks);
  EXPECT_THROW(node_average(mesh, {"n", "", FieldLocation::node, 1, random_values(8, 1)}),
               UsageError);
  EXPECT_THROW(cell_average(mesh, {"c", "", FieldLocation::cell, 1, random_values(1, 1)}),
               UsageError);
}

}  // namespace
}  // namespace hiac
