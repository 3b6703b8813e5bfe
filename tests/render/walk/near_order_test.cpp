#include "hiac/render/walk/near_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

// By the definition, bit by bit.
std::uint32_t interleaved(const std::array<std::uint32_t, 3>& parts) {
  std::uint32_t code = 0;
  for (std::uint32_t bit = 0; bit < 10; ++bit)
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      code |= (parts[axis] >> bit & 1U) << (3 * bit + axis);
  return code;
}

TEST(NearOrder, TakesTheBitsOfCoordinatesInTurns) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::uint32_t> part(0, 1023);
  for (int n = 0; n < 2000; ++n) {
    const std::array<std::uint32_t, 3> parts{part(random), part(random), part(random)};
    ASSERT_EQ(morton_code(parts[0], parts[1], parts[2]), interleaved(parts));
  }
}

// Points of a lattice, 8 on a side of a cube of size 8, and the cube's far corner.
TEST(NearOrder, FollowsMortonsCurveThroughALattice) {
  std::vector<std::array<double, 3>> points{{8, 8, 8}};
  std::vector<std::uint32_t> codes{~0U};
  for (std::uint32_t n = 0; n < 512; ++n) {
    const std::array<std::uint32_t, 3> at{n / 64, n / 8 % 8, n % 8};
    points.push_back(
        {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
    codes.push_back(interleaved(at));
  }
  const ZooMesh mesh = test::make_mesh(points, {});
  std::vector<NodeId> expected(points.size());
  std::iota(expected.begin(), expected.end(), 0U);
  std::ranges::sort(expected, {}, [&](NodeId node) { return codes[node]; });
  EXPECT_EQ(near_order(mesh).nodes, expected);
}

TEST(NearOrder, SortsCellsByTheFirstOfTheirNodes) {
  const ZooMesh mesh = test::random_delaunay(200, 3);
  const NearOrder order = near_order(mesh);
  std::vector<std::uint32_t> number(mesh.node_count());
  for (std::uint32_t n = 0; n < number.size(); ++n) number[order.nodes[n]] = n;
  EXPECT_EQ(numbers_in(order.nodes), number);
  std::vector<CellId> expected(mesh.cell_count());
  std::iota(expected.begin(), expected.end(), 0U);
  std::ranges::stable_sort(expected, {}, [&](CellId cell) {
    std::vector<std::uint32_t> numbers;
    for (const NodeId node : mesh.cell_nodes(cell)) numbers.push_back(number[node]);
    return std::ranges::min(numbers);
  });
  EXPECT_EQ(order.cells, expected);
}

// The mean difference between the numbers of cells that share a face.
double mean_distance(const FaceAdjacency& adjacency, const std::vector<std::uint32_t>& number) {
  double sum = 0;
  int count = 0;
  for (std::size_t face = 0; face < adjacency.neighbors.size(); ++face) {
    const CellId other = adjacency.neighbors[face];
    if (other == kNoCell) continue;
    sum += std::abs(static_cast<double>(number[face / 4]) - static_cast<double>(number[other]));
    ++count;
  }
  return sum / count;
}

TEST(NearOrder, BringsNeighboursTogether) {
  const ZooMesh mesh = test::random_delaunay(2000, 5);
  const FaceAdjacency adjacency = build_face_adjacency(mesh);
  std::vector<std::uint32_t> scattered(mesh.cell_count());
  std::iota(scattered.begin(), scattered.end(), 0U);
  std::ranges::shuffle(scattered, std::mt19937(7));
  EXPECT_LT(mean_distance(adjacency, numbers_in(near_order(mesh).cells)),
            0.15 * mean_distance(adjacency, scattered));
}

TEST(NearOrder, KeepsTheOrderOfWhatIsInOnePlace) {
  const ZooMesh mesh = test::make_mesh(
      {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}},
      {{CellKind::tetrahedron4, {3, 2, 1, 0}}, {CellKind::tetrahedron4, {0, 1, 2, 3}}});
  const NearOrder order = near_order(mesh);
  EXPECT_EQ(order.nodes, (std::vector<NodeId>{0, 1, 2, 3}));
  EXPECT_EQ(order.cells, (std::vector<CellId>{0, 1}));
}

TEST(NearOrder, TakesCoordinatesWhoseDifferenceIsNotFinite) {
  const double huge = 1.5e308;
  const ZooMesh mesh = test::make_mesh({{huge, 0, 0}, {-huge, 0, 0}, {0, huge, 0}, {0, 0, -huge}},
                                       {{CellKind::tetrahedron4, {0, 1, 2, 3}}});
  std::vector<NodeId> nodes = near_order(mesh).nodes;
  std::ranges::sort(nodes);
  EXPECT_EQ(nodes, (std::vector<NodeId>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace hiac
