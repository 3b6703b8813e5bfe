#include "hiac/mesh/parted/split_mesh.hpp"

#include <map>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "tests/mesh/sample_meshes.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

std::vector<std::uint32_t> random_parts(std::size_t cells, std::uint32_t parts, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> result(cells);
  for (std::uint32_t& part : result) part = static_cast<std::uint32_t>(random() % parts);
  return result;
}

/// A grid with nodes of no cell, with fields of every location and metadata.
ZooMesh sample() {
  ZooMesh mesh = samples::tetrahedron_grid(3);
  std::vector<double> xyz(mesh.xyz.begin(), mesh.xyz.end());
  xyz.insert(xyz.begin(), {-1, -1, -1});
  xyz.insert(xyz.end(), {9, 9, 9});
  std::vector<NodeId> nodes(mesh.nodes.begin(), mesh.nodes.end());
  for (NodeId& node : nodes) ++node;
  mesh.xyz = std::move(xyz);
  mesh.nodes = std::move(nodes);
  test::add_counted_fields(mesh);
  mesh.metadata = {{"source", "a test"}};
  mesh.adjacency = build_face_adjacency(mesh);
  return mesh;
}

TEST(SplitMesh, PartsHoldTheWholeMesh) {
  const ZooMesh mesh = sample();
  constexpr std::size_t kParts = 5;
  const auto part_of_cell = random_parts(mesh.cell_count(), kParts, 1);
  const std::vector<MeshPart> parts = split_mesh(mesh, part_of_cell, kParts);
  ASSERT_EQ(parts.size(), kParts);
  std::vector<int> cells_found(mesh.cell_count(), 0), nodes_found(mesh.node_count(), 0);
  for (std::size_t p = 0; p < kParts; ++p) {
    const MeshPart& part = parts[p];
    validate(part.mesh, "part");
    EXPECT_EQ(part.mesh.metadata, mesh.metadata);
    ASSERT_EQ(part.global_nodes.size(), part.mesh.node_count());
    ASSERT_EQ(part.global_cells.size(), part.mesh.cell_count());
    for (NodeId node = 0; node < part.mesh.node_count(); ++node) {
      const auto whole = static_cast<NodeId>(part.global_nodes[node]);
      ++nodes_found[whole];
      if (node > 0) {
        EXPECT_LT(part.global_nodes[node - 1], part.global_nodes[node]);
      }
      for (std::size_t d = 0; d < 3; ++d)
        EXPECT_EQ(part.mesh.position(node)[d], mesh.position(whole)[d]);
      for (std::size_t c = 0; c < 2; ++c)
        EXPECT_EQ(part.mesh.fields[0].values[2 * node + c], mesh.fields[0].values[2 * whole + c]);
    }
    for (CellId cell = 0; cell < part.mesh.cell_count(); ++cell) {
      const auto whole = static_cast<CellId>(part.global_cells[cell]);
      ++cells_found[whole];
      EXPECT_EQ(part_of_cell[whole], p);
      if (cell > 0) {
        EXPECT_LT(part.global_cells[cell - 1], part.global_cells[cell]);
      }
      EXPECT_EQ(part.mesh.kinds[cell], mesh.kinds[whole]);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(part.mesh.fields[1].values[3 * cell + c], mesh.fields[1].values[3 * whole + c]);
      for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(part.global_nodes[part.mesh.cell_nodes(cell)[k]], mesh.cell_nodes(whole)[k]);
        EXPECT_EQ(part.mesh.fields[2].values[4 * cell + k], mesh.fields[2].values[4 * whole + k]);
      }
    }
  }
  for (const int found : cells_found) EXPECT_EQ(found, 1);
  for (const int found : nodes_found) EXPECT_GE(found, 1);
  // nodes of no cell are in part 0 alone
  EXPECT_EQ(nodes_found.front(), 1);
  EXPECT_EQ(parts[0].global_nodes[0], 0U);
  EXPECT_EQ(nodes_found.back(), 1);
}

TEST(SplitMesh, AdjacencyIsThatOfThePartAlone) {
  const ZooMesh mesh = sample();
  for (const MeshPart& part : split_mesh(mesh, random_parts(mesh.cell_count(), 4, 2), 4)) {
    const FaceAdjacency truth = build_face_adjacency(part.mesh);
    ASSERT_TRUE(part.mesh.adjacency.has_value());
    EXPECT_TRUE(std::ranges::equal(part.mesh.adjacency->neighbors, truth.neighbors));
    EXPECT_EQ(part.mesh.adjacency->overshared, 0U);
  }
  ZooMesh without = mesh;
  without.adjacency.reset();
  EXPECT_FALSE(split_mesh(without, random_parts(mesh.cell_count(), 4, 2), 4)[0].mesh.adjacency);
}

TEST(SplitMesh, AFaceOfThreeCellsMayBeOneOfTwoInAPart) {
  ZooMesh mesh = samples::make_mesh({{CellKind::tetrahedron4, {0, 1, 2, 3}},
                                     {CellKind::tetrahedron4, {0, 2, 1, 4}},
                                     {CellKind::tetrahedron4, {0, 1, 2, 5}}},
                                    6);
  mesh.adjacency = build_face_adjacency(mesh);
  ASSERT_EQ(mesh.adjacency->overshared, 1U);
  const std::vector<std::uint32_t> part_of_cell{1, 0, 1};
  for (const MeshPart& part : split_mesh(mesh, part_of_cell, 2)) {
    const FaceAdjacency truth = build_face_adjacency(part.mesh);
    EXPECT_TRUE(std::ranges::equal(part.mesh.adjacency->neighbors, truth.neighbors));
    EXPECT_EQ(part.mesh.adjacency->overshared, 0U);
  }
}

TEST(SplitMesh, EveryKindAndLocation) {
  const ZooMesh mesh = samples::one_of_each_kind();
  std::vector<std::uint32_t> part_of_cell(mesh.cell_count());
  for (std::size_t i = 0; i < part_of_cell.size(); ++i) part_of_cell[i] = i % 3 == 0 ? 1 : 0;
  const auto parts = split_mesh(mesh, part_of_cell, 2);
  ASSERT_EQ(parts[1].mesh.cell_count(), kKindCount / 3);
  for (std::size_t i = 0; i < parts[1].mesh.cell_count(); ++i)
    EXPECT_EQ(parts[1].mesh.kinds[i], static_cast<CellKind>(3 * i));
  for (const MeshPart& part : parts) validate(part.mesh, "part");
}

TEST(SplitMesh, RefusesPartsThatDoNotFit) {
  const ZooMesh mesh = samples::brick_grid(1);
  const std::vector<std::uint32_t> none, two{0, 0}, beyond{1};
  EXPECT_THROW(split_mesh(mesh, none, 1), std::invalid_argument);
  EXPECT_THROW(split_mesh(mesh, two, 1), std::invalid_argument);
  EXPECT_THROW(split_mesh(mesh, beyond, 1), std::invalid_argument);
}

}  // namespace
}  // namespace hiac
