#include "hiac/mesh/face_adjacency.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <gmock/gmock.h>

#include "hiac/base/parallel.hpp"
#include "tests/mesh/sample_meshes.hpp"

namespace hiac {
namespace {

using testing::ElementsAreArray;

/// The definition itself: all faces by their sorted nodes.
FaceAdjacency by_brute_force(const ZooMesh& mesh) {
  std::map<std::vector<NodeId>, std::vector<std::pair<CellId, std::size_t>>> sides;
  std::size_t number = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces) {
      std::vector<NodeId> key;
      for (unsigned i = 0; i < face.corner_count; ++i)
        key.push_back(mesh.cell_nodes(cell)[face.corners[i]]);
      std::ranges::sort(key);
      sides[key].emplace_back(cell, number++);
    }
  std::vector<CellId> neighbors(number, kNoCell);
  std::uint64_t overshared = 0;
  for (const auto& [key, found] : sides) {
    if (found.size() > 2) ++overshared;
    if (found.size() != 2 || found[0].first == found[1].first) continue;
    neighbors[found[0].second] = found[1].first;
    neighbors[found[1].second] = found[0].first;
  }
  return {std::move(neighbors), overshared};
}

void expect_right(const ZooMesh& mesh) {
  const FaceAdjacency expected = by_brute_force(mesh);
  const FaceAdjacency found = build_face_adjacency(mesh);
  EXPECT_THAT(found.neighbors.view(), ElementsAreArray(expected.neighbors.view()));
  EXPECT_EQ(found.overshared, expected.overshared);
}

TEST(FaceAdjacency, TwoBricksShareOneFace) {
  //   3 --- 2 --- 9        bottom; the top is 4 5 6 7 and 5 10 11 6
  //   |  A  |  B  |
  //   0 --- 1 --- 8
  const ZooMesh mesh = samples::make_mesh({{CellKind::brick8, {0, 1, 2, 3, 4, 5, 6, 7}},
                                           {CellKind::brick8, {1, 8, 9, 2, 5, 10, 11, 6}}},
                                          12);
  const FaceAdjacency adjacency = build_face_adjacency(mesh);
  std::vector<CellId> expected(12, kNoCell);
  expected[1] = 1;      // A's face 1 2 6 5
  expected[6 + 0] = 0;  // B's face 0 4 7 3
  EXPECT_THAT(adjacency.neighbors.view(), ElementsAreArray(expected));
  EXPECT_EQ(adjacency.overshared, 0u);
}

TEST(FaceAdjacency, GridsAgreeWithBruteForce) {
  expect_right(samples::make_mesh({}, 0));
  expect_right(samples::make_mesh({}, 5));
  expect_right(samples::one_of_each_kind());
  expect_right(samples::brick_grid(7));
  expect_right(samples::tetrahedron_grid(7));
}

TEST(FaceAdjacency, InnerFacesOfAGridAreAllMatched) {
  const FaceAdjacency adjacency = build_face_adjacency(samples::tetrahedron_grid(10));
  const auto boundary = std::ranges::count(adjacency.neighbors, kNoCell);
  EXPECT_EQ(boundary, 6 * 10 * 10 * 2);
}

// A triangle's three nodes among a quadrilateral's four are no match.
TEST(FaceAdjacency, TrianglesMatchTrianglesAlone) {
  const ZooMesh mesh = samples::make_mesh({{CellKind::pyramid5, {0, 1, 2, 3, 4}},
                                           {CellKind::tetrahedron4, {0, 2, 1, 5}},
                                           {CellKind::tetrahedron4, {0, 1, 4, 5}}},
                                          6);
  const FaceAdjacency adjacency = build_face_adjacency(mesh);
  EXPECT_EQ(adjacency.neighbors[0], kNoCell);
  EXPECT_EQ(adjacency.neighbors[1], 2u);
  expect_right(mesh);
}

TEST(FaceAdjacency, OversharedFacesAreCountedAndUnmatched) {
  const ZooMesh mesh = samples::make_mesh({{CellKind::tetrahedron4, {0, 1, 2, 3}},
                                           {CellKind::tetrahedron4, {0, 1, 2, 4}},
                                           {CellKind::tetrahedron4, {0, 1, 2, 5}}},
                                          6);
  const FaceAdjacency adjacency = build_face_adjacency(mesh);
  EXPECT_EQ(adjacency.overshared, 1u);
  EXPECT_EQ(std::ranges::count(adjacency.neighbors, kNoCell), 12);
}

// Few nodes, so that faces repeat, cells fold onto themselves and every case occurs.
TEST(FaceAdjacency, RandomMeshesAgreeWithBruteForce) {
  std::mt19937 random(20260101);
  for (int round = 0; round < 500; ++round) {
    const std::size_t node_total = 4 + random() % 12;
    std::vector<samples::Cell> cells(1 + random() % 40);
    for (samples::Cell& cell : cells) {
      cell.kind = static_cast<CellKind>(random() % kKindCount);
      for (std::size_t i = 0; i < node_count(cell.kind); ++i)
        cell.nodes.push_back(static_cast<NodeId>(random() % node_total));
    }
    expect_right(samples::make_mesh(cells, node_total));
  }
}

// All faces in one bucket: k log k, or this test does not end.
TEST(FaceAdjacency, HubNodeWithManyFaces) {
  std::vector<samples::Cell> cells;
  const NodeId count = 100000;
  for (NodeId i = 1; i < count; ++i)
    cells.push_back({CellKind::tetrahedron4, {0, i, i + 1, count + 1}});
  const FaceAdjacency adjacency = build_face_adjacency(samples::make_mesh(cells, count + 2));
  EXPECT_EQ(std::ranges::count(adjacency.neighbors, kNoCell), 2 * (count - 1) + 2);
}

TEST(FaceAdjacency, DoesNotDependOnTheNumberOfThreads) {
  const ZooMesh mesh = samples::tetrahedron_grid(20);
  const FaceAdjacency many = build_face_adjacency(mesh);
  const ThreadLimit limit(1);
  EXPECT_THAT(build_face_adjacency(mesh).neighbors.view(), ElementsAreArray(many.neighbors.view()));
}

}  // namespace
}  // namespace hiac
