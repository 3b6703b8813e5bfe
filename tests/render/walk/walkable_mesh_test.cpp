#include "hiac/render/walk/walkable_mesh.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

// The nodes of a face, as the mesh numbers them.
std::set<NodeId> nodes_of(const WalkableMesh& walkable, OppositeFace face) {
  std::set<NodeId> nodes;
  for (std::size_t k = 0; k < 4; ++k)
    if (k != face.opposite()) nodes.insert(walkable.node_of_mesh(walkable[face.cell()].nodes[k]));
  return nodes;
}

TEST(WalkableMesh, HasTheCellsOfTheMesh) {
  const ZooMesh mesh = test::random_delaunay(30, 4);
  const auto walkable = WalkableMesh::of(mesh, build_face_adjacency(mesh));
  ASSERT_TRUE(walkable.has_value());
  ASSERT_EQ(walkable->cell_count(), mesh.cell_count());
  ASSERT_EQ(walkable->node_count(), mesh.node_count());
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_EQ(walkable->node_of_mesh((*walkable)[cell].nodes[k]),
                mesh.cell_nodes(walkable->cell_of_mesh(cell))[k]);
}

TEST(WalkableMesh, KnowsWhatLiesAcrossFaces) {
  const ZooMesh mesh = test::random_delaunay(30, 4);
  const auto walkable = WalkableMesh::of(mesh, build_face_adjacency(mesh));
  ASSERT_TRUE(walkable.has_value());
  std::vector<OppositeFace> faces;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    for (std::size_t k = 0; k < 4; ++k) faces.emplace_back(cell, k);
  std::size_t outside = 0;
  for (const OppositeFace face : faces) {
    // by brute force
    OppositeFace other;
    for (const OppositeFace f : faces)
      if (f != face && nodes_of(*walkable, f) == nodes_of(*walkable, face)) other = f;
    ASSERT_EQ((*walkable)[face.cell()].across[face.opposite()], other);
    outside += other.exists() ? 0 : 1;
    const auto& boundary = walkable->boundary();
    const auto found = std::ranges::find(boundary, face, &BoundaryFace::face);
    ASSERT_EQ(found != boundary.end(), !other.exists());
    if (other.exists()) continue;
    std::set<NodeId> corners;
    for (const NodeId corner : found->corners) corners.insert(walkable->node_of_mesh(corner));
    EXPECT_EQ(corners, nodes_of(*walkable, face));
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
    EXPECT_EQ(first->cell_of_mesh(cell), second.cell_of_mesh(cell));
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

// Its node that is there twice is the one beyond the face.
TEST(WalkableMesh, HasNoNeighbourWithANodeTwice) {
  ZooMesh mesh = test::make_mesh(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{CellKind::tetrahedron4, {0, 1, 2, 3}}, {CellKind::tetrahedron4, {1, 0, 2, 4}}});
  const FaceAdjacency adjacency = build_face_adjacency(mesh);
  EXPECT_TRUE(WalkableMesh::of(mesh, adjacency).has_value());
  mesh.nodes = std::vector<NodeId>{0, 1, 2, 3, 1, 0, 2, 2};
  EXPECT_FALSE(WalkableMesh::of(mesh, adjacency).has_value());
}

// The exclusive or of both faces' nodes is the same, 7.
TEST(WalkableMesh, RefusesANeighbourWithOtherNodes) {
  const std::vector<test::Position> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0},
                                              {0, 2, 0}, {0, 0, 2}, {3, 0, 0}, {0, 3, 0}};
  const ZooMesh mesh = test::make_mesh(
      positions, {{CellKind::tetrahedron4, {0, 1, 2, 4}}, {CellKind::tetrahedron4, {8, 3, 5, 1}}});
  FaceAdjacency adjacency = build_face_adjacency(mesh);
  const std::vector<CellId> alone(8, kNoCell);
  ASSERT_TRUE(std::ranges::equal(adjacency.neighbors, alone));
  EXPECT_TRUE(WalkableMesh::of(mesh, adjacency).has_value());
  // the face opposite the first node, whatever its number
  for (std::size_t face = 0; face < 4; ++face) {
    std::vector<CellId> joined = alone;
    joined[face] = 1;
    joined[4 + face] = 0;
    adjacency.neighbors = std::vector<CellId>(joined);
    EXPECT_FALSE(WalkableMesh::of(mesh, adjacency).has_value()) << face;
  }
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
