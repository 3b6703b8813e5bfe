#include "hiac/check/interior_point.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "hiac/geometry/inverse_map.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::test {
namespace {

/// A bent cell of a kind, of a size, at a place.
ZooMesh bent_cell(CellKind kind, double size, const Position& at) {
  std::vector<Position> places;
  Cell cell{kind, {}};
  for (const auto& p : reference_nodes(kind)) {
    cell.nodes.push_back(static_cast<NodeId>(places.size()));
    const Position q{p[0] + p[1] * p[2] / 16, p[1] + p[2] * p[2] / 16, p[2] + p[0] * p[0] / 16};
    places.push_back({at[0] + size * q[0], at[1] + size * q[1], at[2] + size * q[2]});
  }
  return make_mesh(places, {cell});
}

CellMap map_of(const ZooMesh& mesh, CellId cell) {
  std::vector<CellMap::Point> nodes;
  for (const NodeId node : mesh.cell_nodes(cell)) {
    const auto p = mesh.position(node);
    nodes.push_back({p[0], p[1], p[2]});
  }
  return {mesh.kinds[cell], nodes, 0};
}

/// Whether the point is inside the brick, by continuation along a line.
bool is_in_brick(const ZooMesh& mesh, CellId cell, const Position& at) {
  const CellMap map = map_of(mesh, cell);
  return std::ranges::all_of(map.reference(at, map.middle()),
                             [](double x) { return x > 0 && x < 1; });
}

// A speck in a large cell is found from the speck, whichever is named first, and is in both.
TEST(InteriorPoint, ASmallCellInALargeOne) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0.2, 0.8);
  for (const CellKind kind : {CellKind::brick8, CellKind::brick20, CellKind::brick32})
    for (int round = 0; round < 20; ++round) {
      const ZooMesh large = bent_cell(kind, 1, {0, 0, 0});
      const Position at{unit(random), unit(random), unit(random)};
      const ZooMesh small = bent_cell(kind, 1.0 / 256, at);
      for (const bool first : {true, false}) {
        const ZooMesh mesh = first ? side_by_side(small, large) : side_by_side(large, small);
        const auto found = common_interior_point(mesh, 0, 1);
        ASSERT_TRUE(found.has_value()) << kind_name(kind);
        EXPECT_GT(found->depth, 1e-5);
        EXPECT_TRUE(is_in_brick(mesh, 0, found->at));
        EXPECT_TRUE(is_in_brick(mesh, 1, found->at));
      }
    }
}

// Neighbours that share a bent face, with rounded places of their own, and cells that are apart.
TEST(InteriorPoint, NoneWhereCellsOnlyTouch) {
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    const ZooMesh cell = moved(bent_cell(kind, 1, {0.1, 0.2, 0.3}), [](const Position& p) {
      return Position{p[0] / 3, p[1] / 3, p[2] / 3};
    });
    const ZooMesh apart = side_by_side(cell, moved(cell, [](const Position& p) {
                                         return Position{p[0], p[1] + 0.5, p[2]};
                                       }));
    EXPECT_FALSE(common_interior_point(apart, 0, 1).has_value()) << kind_name(kind);
  }
  const ZooMesh column = moved(structured(2, Cut::bricks), [](const Position& p) {
    return Position{p[0] / 3 + p[1] * p[2] / 7, p[1] / 3, p[2] / 3 + p[0] * p[1] / 5};
  });
  for (CellId a = 0; a < 8; ++a)
    for (CellId b = 0; b < a; ++b)
      EXPECT_FALSE(common_interior_point(column, a, b).has_value()) << a << " " << b;
}

}  // namespace
}  // namespace hiac::test
