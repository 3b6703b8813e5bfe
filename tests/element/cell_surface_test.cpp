#include "hiac/element/cell_surface.hpp"

#include <algorithm>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace hiac {
namespace {

constexpr std::array kSurfaceKinds{CellKind::tetrahedron4, CellKind::pyramid5, CellKind::prism6,
                                   CellKind::wedge7, CellKind::brick8};

using Nodes = std::vector<NodeId>;

// The triangles of a cell's faces by their nodes, ascending, each with its face: quadrilaterals are
// cut from their smallest node.
std::set<std::pair<Nodes, std::size_t>> expected_triangles(CellKind kind, const Nodes& nodes) {
  std::set<std::pair<Nodes, std::size_t>> triangles;
  const auto faces = topology_of(kind).faces;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    Nodes around;
    for (std::size_t k = 0; k < faces[f].corner_count; ++k)
      around.push_back(nodes[faces[f].corners[k]]);
    std::ranges::rotate(around, std::ranges::min_element(around));
    for (std::size_t k = 2; k < around.size(); ++k) {
      Nodes triangle{around[0], around[k - 1], around[k]};
      std::ranges::sort(triangle);
      triangles.emplace(triangle, f);
    }
  }
  return triangles;
}

TEST(CellSurface, IsMadeOfTrianglesOfAscendingNodes) {
  std::mt19937 random(1);
  for (const CellKind kind : kSurfaceKinds)
    for (int trial = 0; trial < 50; ++trial) {
      std::set<NodeId> numbers;
      while (numbers.size() < corner_count(kind)) numbers.insert(static_cast<NodeId>(random()));
      Nodes nodes(numbers.begin(), numbers.end());
      std::ranges::shuffle(nodes, random);
      const CellSurface surface = cell_surface(kind, nodes);
      ASSERT_EQ(surface.corner_count, nodes.size());
      EXPECT_TRUE(std::ranges::equal(std::span(surface.nodes).first(nodes.size()), numbers));
      for (std::size_t k = 0; k < nodes.size(); ++k)
        EXPECT_EQ(surface.nodes[surface.ranks[k]], nodes[k]);
      std::set<std::pair<Nodes, std::size_t>> triangles;
      std::set<std::pair<int, int>> pairs;
      for (std::size_t t = 0; t < surface.triangle_count; ++t) {
        const CellSurface::Triangle& triangle = surface.triangles[t];
        const auto& [a, b, c] = triangle.corners;
        triangles.emplace(Nodes{surface.nodes[a], surface.nodes[b], surface.nodes[c]},
                          triangle.face);
        EXPECT_EQ(triangle.edges[0], surface.edge_between(a, b));
        EXPECT_EQ(triangle.edges[1], surface.edge_between(c, a));
        EXPECT_EQ(triangle.edges[2], surface.edge_between(b, c));
        pairs.insert({{a, b}, {a, c}, {b, c}});
      }
      EXPECT_EQ(triangles, expected_triangles(kind, nodes)) << kind_name(kind);
      EXPECT_EQ(surface.triangle_count, triangles.size());
      EXPECT_EQ(surface.edge_count, pairs.size());
      // a closed surface of triangles: Euler's formula
      EXPECT_EQ(surface.corner_count + surface.triangle_count, surface.edge_count + 2);
    }
}

}  // namespace
}  // namespace hiac
