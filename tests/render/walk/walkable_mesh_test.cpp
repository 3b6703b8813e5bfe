#include "hiac/render/walk/walkable_mesh.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

TEST(WalkableMesh, KnowsWhatLiesAcrossFaces) {
  const ZooMesh mesh = test::random_delaunay(30, 4);
  const FaceAdjacency adjacency = build_face_adjacency(mesh);
  const auto walkable = WalkableMesh::of(mesh, adjacency);
  ASSERT_TRUE(walkable.has_value());
  std::size_t outside = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    for (std::uint8_t k = 0; k < 4; ++k) {
      std::set<NodeId> face;
      for (std::uint8_t n = 0; n < 4; ++n)
        if (n != k) face.insert((*walkable)[cell].nodes[n]);
      // by brute force
      CellId other = kNoCell;
      for (CellId c = 0; c < mesh.cell_count(); ++c) {
        const auto nodes = mesh.cell_nodes(c);
        if (c != cell && std::ranges::all_of(face, [&](NodeId node) {
              return std::ranges::find(nodes, node) != nodes.end();
            }))
          other = c;
      }
      ASSERT_EQ((*walkable)[cell].across[k], other);
      outside += other == kNoCell;
      const auto& boundary = walkable->boundary();
      const auto found = std::ranges::find(boundary, OppositeFace{cell, k}, &BoundaryFace::face);
      ASSERT_EQ(found != boundary.end(), other == kNoCell);
      if (other == kNoCell) {
        EXPECT_EQ(std::set(found->corners.begin(), found->corners.end()), face);
      }
    }
  EXPECT_EQ(walkable->boundary().size(), outside);
  EXPECT_GT(outside, 10U);
}

TEST(WalkableMesh, IsMadeAgainAsItWas) {
  const ZooMesh mesh = test::random_delaunay(30, 4);
  const FaceAdjacency adjacency = build_face_adjacency(mesh);
  const auto first = WalkableMesh::of(mesh, adjacency);
  ASSERT_TRUE(first.has_value());
  const WalkableMesh second = WalkableMesh::again(mesh, adjacency);
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    EXPECT_EQ((*first)[cell].nodes, second[cell].nodes);
    EXPECT_EQ((*first)[cell].across, second[cell].across);
  }
  EXPECT_TRUE(std::ranges::equal(first->boundary(), second.boundary(), {}, &BoundaryFace::face,
                                 &BoundaryFace::face));
  EXPECT_FALSE(second.boundary().empty());
}

TEST(WalkableMesh, IsOfLinearTetrahedraAlone) {
  for (const test::Cut cut : {test::Cut::bricks, test::Cut::prisms, test::Cut::pyramids}) {
    const ZooMesh mesh = test::structured(2, cut);
    EXPECT_FALSE(WalkableMesh::of(mesh, build_face_adjacency(mesh)).has_value());
  }
  const ZooMesh mesh = test::structured(2, test::Cut::tetrahedra);
  EXPECT_TRUE(WalkableMesh::of(mesh, build_face_adjacency(mesh)).has_value());
}

TEST(WalkableMesh, HasNoCellWithANodeTwice) {
  ZooMesh mesh = test::make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                 {{CellKind::tetrahedron4, {0, 1, 2, 3}}});
  EXPECT_TRUE(WalkableMesh::of(mesh, build_face_adjacency(mesh)).has_value());
  mesh.nodes = std::vector<NodeId>{0, 1, 2, 1};
  EXPECT_FALSE(WalkableMesh::of(mesh, build_face_adjacency(mesh)).has_value());
}

// An adjacency may come from a file.
TEST(WalkableMesh, RefusesAnAdjacencyOfAnotherMesh) {
  const ZooMesh mesh = test::random_delaunay(20, 5);
  const FaceAdjacency good = build_face_adjacency(mesh);
  const auto is_taken = [&](const std::vector<CellId>& neighbors) {
    return WalkableMesh::of(mesh, FaceAdjacency{.neighbors = std::vector<CellId>(neighbors)})
        .has_value();
  };
  const std::vector<CellId> right(good.neighbors.begin(), good.neighbors.end());
  ASSERT_TRUE(is_taken(right));
  const auto inner = static_cast<std::size_t>(
      std::ranges::find_if(right, [](CellId c) { return c != kNoCell; }) - right.begin());
  for (const CellId wrong :
       {kNoCell, static_cast<CellId>(mesh.cell_count()), static_cast<CellId>(inner / 4),
        right[inner] == 7 ? CellId{8} : CellId{7}}) {
    std::vector<CellId> neighbors = right;
    neighbors[inner] = wrong;
    EXPECT_FALSE(is_taken(neighbors)) << wrong;
  }
  std::vector<CellId> fewer = right;
  fewer.pop_back();
  EXPECT_FALSE(is_taken(fewer));
  // a face that neither of its cells knows as shared is the boundary's
  std::vector<CellId> parted = right;
  const auto own = static_cast<CellId>(inner / 4);
  for (std::size_t k = 0; k < 4; ++k)
    if (parted[4 * right[inner] + k] == own) parted[4 * right[inner] + k] = kNoCell;
  parted[inner] = kNoCell;
  EXPECT_TRUE(is_taken(parted));
}

}  // namespace
}  // namespace hiac
