// The boundary of a mesh, found by its parts, against that of the whole.
#include "hiac/cluster/whole_boundary.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/frame/surfaces/boundary_faces.hpp"
#include "hiac/mesh/parted/split_mesh.hpp"
#include "tests/cluster/parts_of.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

void expect_boundary_of_whole(const ZooMesh& mesh, std::uint32_t parts) {
  std::mt19937_64 random(parts);
  std::vector<std::uint32_t> part_of_cell(mesh.cell_count());
  for (std::uint32_t& part : part_of_cell) part = static_cast<std::uint32_t>(random() % parts);
  const std::vector<std::uint8_t> truth = boundary_faces(mesh);
  const std::vector<MeshPart> split = split_mesh(mesh, part_of_cell, parts);
  for (const std::uint32_t ranks : {1U, 3U}) {
    std::vector<int> seen(mesh.cell_count(), 0);
    std::vector<std::vector<std::uint8_t>> found(parts);
    test::run_ranks(ranks, [&](Communicator& all) {
      std::vector<NumberedPart> own;
      for (std::uint32_t part = all.rank(); part < parts; part += ranks)
        own.push_back({part, split[part].mesh, split[part].global_nodes.view()});
      const auto boundary = whole_boundary(all, own);
      ASSERT_EQ(boundary.size(), own.size());
      for (std::size_t k = 0; k < own.size(); ++k) found[own[k].number] = boundary[k];
    });
    for (std::uint32_t part = 0; part < parts; ++part)
      for (CellId cell = 0; cell < split[part].mesh.cell_count(); ++cell) {
        const std::uint64_t whole = split[part].global_cells[cell];
        EXPECT_EQ(found[part][cell], truth[whole]) << "cell " << whole << " of part " << part;
        ++seen[whole];
      }
    EXPECT_TRUE(std::ranges::all_of(seen, [](int times) { return times == 1; }));
  }
}

TEST(WholeBoundary, IsThatOfTheWholeMesh) {
  for (const std::uint32_t parts : {1U, 2U, 7U}) {
    expect_boundary_of_whole(test::random_delaunay(150, 2), parts);
    expect_boundary_of_whole(test::mixed_columns(3), parts);
    // two bodies beside one another, and cells of higher order
    expect_boundary_of_whole(test::side_by_side(test::structured(3, test::Cut::bricks),
                                                test::structured(2, test::Cut::pyramids)),
                             parts);
    for (const CellKind kind : test::all_kinds())
      expect_boundary_of_whole(test::straight_mesh(kind, 2), parts);
  }
}

// Tetrahedra on one triangle: three of them, or two that lie on the same side.
TEST(WholeBoundary, FacesOfSeveralCells) {
  ZooMesh mesh;
  mesh.xyz = std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.2, 0.2, 2, 0.3, 0.3, -1};
  mesh.kinds = std::vector<CellKind>(3, CellKind::tetrahedron4);
  mesh.elems = std::vector<std::uint64_t>{0, 4, 8, 12};
  mesh.nodes = std::vector<NodeId>{0, 1, 2, 3, 0, 1, 2, 4, 0, 2, 1, 5};
  const std::vector<std::uint8_t> truth = boundary_faces(mesh);
  EXPECT_TRUE(std::ranges::all_of(truth, [](std::uint8_t faces) { return faces == 15; }));
  // two of them in one part, where that face is between two cells
  for (const std::vector<std::uint32_t>& part_of_cell :
       {std::vector<std::uint32_t>{0, 0, 1}, {0, 1, 2}, {0, 1, 0}, {1, 0, 0}}) {
    const std::vector<MeshPart> split = split_mesh(mesh, part_of_cell, 3);
    test::run_ranks(2, [&](Communicator& all) {
      std::vector<NumberedPart> own;
      for (std::uint32_t part = all.rank(); part < 3; part += 2)
        own.push_back({part, split[part].mesh, split[part].global_nodes.view()});
      for (const auto& part : whole_boundary(all, own))
        for (const std::uint8_t faces : part) EXPECT_EQ(faces, 15);
    });
  }
}

}  // namespace
}  // namespace hiac
