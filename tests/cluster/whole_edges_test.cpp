// The edges that the parts of a mesh draw, against those that the whole chooses.
#include "hiac/cluster/whole_edges.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/cluster/whole_boundary.hpp"
#include "hiac/frame/surfaces/boundary_faces.hpp"
#include "hiac/mesh/parted/split_mesh.hpp"
#include "hiac/render/edges/chosen_edges.hpp"
#include "tests/cluster/parts_of.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

// The nodes of an edge, in the whole mesh.
std::vector<std::uint64_t> named(const EdgeNodes& edge, std::span<const std::uint64_t> numbers) {
  std::vector<std::uint64_t> nodes;
  for (std::size_t k = 0; k < edge.count; ++k) nodes.push_back(numbers[edge.nodes[k]]);
  return nodes;
}

void expect_edges_of_whole(const ZooMesh& mesh, const Edges& wanted, std::uint32_t parts) {
  std::mt19937_64 random(parts);
  std::vector<std::uint32_t> part_of_cell(mesh.cell_count());
  for (std::uint32_t& part : part_of_cell) part = static_cast<std::uint32_t>(random() % parts);
  std::vector<std::uint64_t> same(mesh.node_count());
  for (std::size_t k = 0; k < same.size(); ++k) same[k] = k;
  std::vector<std::vector<std::uint64_t>> truth;
  for (const EdgeNodes& edge : chosen_edges(mesh, wanted, boundary_faces(mesh)))
    truth.push_back(named(edge, same));
  const std::vector<MeshPart> split = split_mesh(mesh, part_of_cell, parts);
  for (const std::uint32_t ranks : {1U, 3U}) {
    std::vector<std::vector<EdgeNodes>> of_part(parts);
    test::run_ranks(ranks, [&](Communicator& all) {
      std::vector<NumberedPart> own;
      for (std::uint32_t part = all.rank(); part < parts; part += ranks)
        own.push_back({part, split[part].mesh, split[part].global_nodes.view()});
      const auto edges = whole_edges(all, own, wanted, whole_boundary(all, own));
      for (std::size_t k = 0; k < own.size(); ++k) of_part[own[k].number] = edges[k];
    });
    std::vector<std::vector<std::uint64_t>> found;
    for (std::uint32_t part = 0; part < parts; ++part) {
      EXPECT_TRUE(std::ranges::is_sorted(of_part[part], {}, ends_of));
      for (const EdgeNodes& edge : of_part[part])
        found.push_back(named(edge, split[part].global_nodes.view()));
    }
    std::ranges::sort(found);
    std::ranges::sort(truth);
    EXPECT_EQ(found, truth) << parts << " parts, " << ranks << " ranks";
  }
}

TEST(WholeEdges, AreThoseOfTheWholeMesh) {
  for (const EdgeChoice show : {EdgeChoice::feature, EdgeChoice::boundary, EdgeChoice::all})
    for (const std::uint32_t parts : {1U, 2U, 6U}) {
      const Edges wanted{.show = show, .angle = 20};
      expect_edges_of_whole(test::random_delaunay(150, 2), wanted, parts);
      expect_edges_of_whole(test::mixed_columns(3), wanted, parts);
      expect_edges_of_whole(test::side_by_side(test::structured(3, test::Cut::bricks),
                                               test::structured(2, test::Cut::pyramids)),
                            wanted, parts);
      for (const CellKind kind : test::all_kinds())
        expect_edges_of_whole(test::curved_mesh(kind), wanted, parts);
    }
}

}  // namespace
}  // namespace hiac
