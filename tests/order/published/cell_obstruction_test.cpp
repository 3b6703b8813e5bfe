#include "hiac/order/published/cell_obstruction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/order/published/stein.hpp"
#include "hiac/order/published/visibility_cycle.hpp"
#include "tests/order/brute_force_order.hpp"
#include "tests/order/order_meshes.hpp"

namespace hiac::test {
namespace {

constexpr double kPlanarity = 1e-10;

using Real = long double;
using Vec = std::array<Real, 3>;

Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Corners of one cell of each shape, within the unit cube, with planar faces.
const std::vector<std::vector<Position>>& shapes() {
  static const std::vector<std::vector<Position>> kShapes{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.25, 0.5, 1}},
      {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}},
      {{0, 0, 0}, {1, 0, 0}, {0.75, 1, 0}, {0.25, 1, 0}, {0.25, 0, 1}, {0.75, 0, 1}, {0.5, 1, 1}},
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  return kShapes;
}

struct Solid {
  CellKind kind;
  std::vector<Position> corners;

  [[nodiscard]] Vec at(std::size_t k) const {
    return {corners[k][0], corners[k][1], corners[k][2]};
  }
};

// A random shape, long and thin, turned and put somewhere in the unit cube.
Solid random_solid(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal;
  const auto shape = static_cast<CellShape>(random() % kShapeCount);
  std::array<Position, 3> axes{};
  const double length = 0.3 + 0.7 * unit(random), width = 0.05 + 0.2 * unit(random);
  for (std::size_t a = 0; a < 3; ++a) {
    for (double& x : axes[a]) x = normal(random);
    for (std::size_t b = 0; b < a; ++b) {
      double product = 0, square = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        product += axes[a][c] * axes[b][c];
        square += axes[b][c] * axes[b][c];
      }
      for (std::size_t c = 0; c < 3; ++c) axes[a][c] -= product / square * axes[b][c];
    }
    const double size = std::hypot(axes[a][0], axes[a][1], axes[a][2]);
    for (double& x : axes[a]) x *= (a == 2 ? length : width) / size;
  }
  const Position place{unit(random), unit(random), unit(random)};
  Solid solid{kind_of(shape, CellOrder::linear), {}};
  for (const Position& p : shapes()[static_cast<std::size_t>(shape)]) {
    Position q = place;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t a = 0; a < 3; ++a) q[c] += (p[a] - 0.5) * axes[a][c];
    solid.corners.push_back(q);
  }
  return solid;
}

// Whether the solids lie apart, by all planes that can tell: those of faces and those along an edge
// of each.
bool apart(const Solid& p, const Solid& q) {
  std::vector<Vec> normals;
  std::vector<Vec> p_edges, q_edges;
  for (const ShapeEdge& e : topology_of(p.kind).edges)
    p_edges.push_back(minus(p.at(e[1]), p.at(e[0])));
  for (const ShapeEdge& e : topology_of(q.kind).edges)
    q_edges.push_back(minus(q.at(e[1]), q.at(e[0])));
  for (const auto* edges : {&p_edges, &q_edges})
    for (const Vec& e : *edges)
      for (const Vec& f : *edges) normals.push_back(cross(e, f));
  for (const Vec& e : p_edges)
    for (const Vec& f : q_edges) normals.push_back(cross(e, f));
  return std::ranges::any_of(normals, [&](const Vec& n) {
    Real p_most = -1e9L, q_least = 1e9L;
    for (std::size_t k = 0; k < p.corners.size(); ++k) p_most = std::max(p_most, dot(n, p.at(k)));
    for (std::size_t k = 0; k < q.corners.size(); ++k) q_least = std::min(q_least, dot(n, q.at(k)));
    return p_most < q_least;
  });
}

ZooMesh mesh_of(const std::vector<Solid>& solids) {
  std::vector<Position> positions;
  std::vector<Cell> cells;
  for (const Solid& solid : solids) {
    Cell cell{solid.kind, {}};
    for (const Position& p : solid.corners) {
      cell.nodes.push_back(static_cast<NodeId>(positions.size()));
      positions.push_back(p);
    }
    cells.push_back(std::move(cell));
  }
  return make_mesh(positions, cells);
}

// Cells of all shapes that lie apart, in each other's way as much as can be.
std::vector<Solid> random_solids(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Solid> solids;
  for (int attempt = 0; attempt < 4000 && solids.size() < count; ++attempt) {
    Solid solid = random_solid(random);
    if (std::ranges::all_of(
            solids, [&](const Solid& other) { return apart(solid, other) || apart(other, solid); }))
      solids.push_back(std::move(solid));
  }
  return solids;
}

// The solid, shrunk towards one of its corners: a part of it.
Solid shrunk(Solid solid, std::size_t corner, double factor) {
  const Position center = solid.corners[corner];
  for (Position& p : solid.corners)
    for (std::size_t c = 0; c < 3; ++c) p[c] = center[c] + factor * (p[c] - center[c]);
  return solid;
}

// Whether no ray finds `behind` before `front`, and some ray finds them the other way round; where
// little of them overlaps, one through parts of them.
bool is_seen_before(const Solid& front, const Solid& behind, const View& view, std::uint64_t seed) {
  const auto holds = [&](const Solid& p, const Solid& q, std::vector<CellId> cells) {
    return holds_along_rays(mesh_of({p, q}), view, {std::move(cells), {}, ""}, 500, seed);
  };
  EXPECT_TRUE(holds(front, behind, {0, 1}));
  for (const double factor : {1.0, 0.4, 0.15, 0.05}) {
    for (std::size_t k = 0; k < front.corners.size(); ++k)
      if (!holds(shrunk(front, k, factor), behind, {1, 0})) return true;
    for (std::size_t k = 0; k < behind.corners.size(); ++k)
      if (!holds(front, shrunk(behind, k, factor), {1, 0})) return true;
  }
  return false;
}

// Orders hold along rays; in cycles every cell is seen before the next one.
TEST(CellObstruction, SolidsOfAllShapesThatLieApart) {
  int orders = 0, cycles = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const std::vector<Solid> solids = random_solids(seed % 2 == 0 ? 10 : 40, seed);
    const ZooMesh mesh = mesh_of(solids);
    for (const auto& [name, view] : all_views()) {
      SCOPED_TRACE(name);
      try {
        const VisibilityOrder order = stein_order(mesh, view, kPlanarity);
        ++orders;
        ASSERT_TRUE(holds_along_rays(mesh, view, order, 300, seed));
      } catch (const VisibilityCycle& cycle) {
        ++cycles;
        const auto& cells = cycle.cells();
        for (std::size_t i = 0; i < cells.size(); ++i)
          ASSERT_TRUE(
              is_seen_before(solids[cells[i]], solids[cells[(i + 1) % cells.size()]], view, seed));
      }
    }
  }
  EXPECT_GT(orders, 10);
  EXPECT_GT(cycles, 3);
}

// Every pair of cells against rays: what rays find has to be said.
TEST(CellObstruction, PairsOfSolids) {
  const std::vector<Solid> solids = random_solids(12, 9);
  const ZooMesh mesh = mesh_of(solids);
  for (const auto& [name, view] : many_views()) {
    SCOPED_TRACE(name);
    const CellObstruction obstruction(mesh, view, kPlanarity);
    for (CellId i = 0; i < mesh.cell_count(); ++i)
      for (CellId j = 0; j < i; ++j) {
        auto p = obstruction.cell(i), q = obstruction.cell(j);
        const bool before = obstruction.obstructs(p, q), behind = obstruction.obstructs(q, p);
        ASSERT_FALSE(before && behind);
        const ZooMesh two = mesh_of({solids[i], solids[j]});
        const auto holds = [&, &seen_from = view](std::vector<CellId> cells) {
          return holds_along_rays(two, seen_from, {std::move(cells), {}, ""}, 60, i);
        };
        ASSERT_TRUE(behind || holds({0, 1}));
        ASSERT_TRUE(before || holds({1, 0}));
      }
  }
}

// Quadrilaterals that are warped have Newell's plane: an order comes out, or a cycle. (Bricks of a
// lattice with warped sides overlap by as much on the screen when seen along them.)
TEST(CellObstruction, WarpedQuadrilaterals) {
  for (const double warp : {1e-12, 1e-6, 0.05}) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> offset(-warp, warp);
    const ZooMesh mesh = moved(structured(3, Cut::bricks), [&](const Position& p) {
      return Position{p[0] + offset(random), p[1] + offset(random), p[2] + offset(random)};
    });
    int orders = 0;
    for (const auto& [name, view] : all_views()) {
      SCOPED_TRACE(name);
      try {
        const VisibilityOrder order = stein_order(mesh, view, kPlanarity);
        ++orders;
        ASSERT_TRUE(is_sequence_of_groups(order, mesh.cell_count()));
        // rays leave out pieces shorter than what such a warp makes
        if (warp < 1e-11) {
          ASSERT_TRUE(holds_along_rays(mesh, view, order, 100, 1));
        }
      } catch (const VisibilityCycle& cycle) {
        EXPECT_LE(cycle.cells().size(), mesh.cell_count());
      }
    }
    EXPECT_GT(orders, 10);
  }
}

}  // namespace
}  // namespace hiac::test
