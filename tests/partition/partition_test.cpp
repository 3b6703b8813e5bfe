#include "hiac/partition/partition.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/parted/cell_weight.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using test::Cut;
using test::structured;

/// The largest weight of a part over the mean, from the definition.
double balance(const ZooMesh& mesh, const std::vector<std::uint32_t>& part_of_cell,
               std::size_t parts) {
  std::vector<double> weights(parts, 0);
  double total = 0;
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
    weights[part_of_cell[cell]] += cell_weight(mesh.kinds[cell]);
    total += cell_weight(mesh.kinds[cell]);
  }
  return *std::ranges::max_element(weights) * static_cast<double>(parts) / total;
}

/// How many pairs of cells that share a face are in different parts.
std::size_t cut_faces(const ZooMesh& mesh, const std::vector<std::uint32_t>& part_of_cell) {
  const FaceAdjacency adjacency = build_face_adjacency(mesh);
  std::size_t face = 0, cut = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    for (std::size_t k = 0; k < face_count(mesh.kinds[cell]); ++k, ++face) {
      const CellId other = adjacency.neighbors[face];
      if (other != kNoCell && other > cell && part_of_cell[cell] != part_of_cell[other]) ++cut;
    }
  return cut;
}

/// Bricks, prisms, pyramids and tetrahedra side by side: 12,288 cells of four kinds.
ZooMesh mixed() {
  return test::side_by_side(
      test::side_by_side(structured(12, Cut::bricks), structured(12, Cut::prisms)),
      test::side_by_side(structured(8, Cut::pyramids), structured(8, Cut::tetrahedra)));
}

TEST(Partition, DividesACubeWithFewFacesInCommon) {
  const ZooMesh mesh = structured(8, Cut::bricks);
  const auto part_of_cell = partition_cells(mesh, 8, "cube");
  EXPECT_LE(balance(mesh, part_of_cell, 8), 1.05);
  // eight cubes of four bricks an edge have 192 faces in common
  EXPECT_LE(cut_faces(mesh, part_of_cell), 192 * 13 / 10);
  EXPECT_EQ(partition_cells(mesh, 8, "cube"), part_of_cell);
}

TEST(Partition, WeighsCellsOfMixedKinds) {
  const ZooMesh mesh = mixed();
  for (const std::size_t parts : {2, 3, 7, 64}) {
    const auto part_of_cell = partition_cells(mesh, parts, "mixed");
    EXPECT_EQ(std::set(part_of_cell.begin(), part_of_cell.end()).size(), parts);
    EXPECT_LE(balance(mesh, part_of_cell, parts), 1.05) << parts << " parts";
  }
}

TEST(Partition, DoesNotDependOnAStoredAdjacency) {
  ZooMesh mesh = mixed();
  const auto part_of_cell = partition_cells(mesh, 5, "mixed");
  mesh.adjacency = build_face_adjacency(mesh);
  EXPECT_EQ(partition_cells(mesh, 5, "mixed"), part_of_cell);
}

TEST(Partition, CellsWithoutNeighboursAndPartsOfOneCell) {
  ZooMesh apart = structured(1, Cut::bricks);
  for (int i = 0; i < 4; ++i) apart = test::side_by_side(apart, structured(1, Cut::bricks));
  for (std::size_t parts = 1; parts <= 5; ++parts) {
    const auto part_of_cell = partition_cells(apart, parts, "apart");
    EXPECT_EQ(std::set(part_of_cell.begin(), part_of_cell.end()).size(), parts);
  }
  const ZooMesh mesh = structured(3, Cut::tetrahedra);
  const auto part_of_cell = partition_cells(mesh, mesh.cell_count(), "all");
  EXPECT_EQ(std::set(part_of_cell.begin(), part_of_cell.end()).size(), mesh.cell_count());
}

TEST(Partition, RefusesImpossibleNumbers) {
  const ZooMesh mesh = structured(1, Cut::tetrahedra);
  const auto told = [&](std::size_t parts) -> std::string {
    try {
      partition_cells(mesh, parts, "cube");
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(told(0), "0 parts of 6 cells (1 to 6 parts expected)");
  EXPECT_EQ(told(6), "");
  EXPECT_EQ(told(7), "7 parts of 6 cells (1 to 6 parts expected)");
}

}  // namespace
}  // namespace hiac
