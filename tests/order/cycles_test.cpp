// Visibility cycles: found where they are and nowhere else, and drawn right.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/render/engine.hpp"
#include "hiac/scene/view_of.hpp"
#include "tests/geometry/rational_orientation.hpp"
#include "tests/order/brute_force_order.hpp"
#include "tests/order/exact_relation.hpp"
#include "tests/order/hard_meshes.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/reference.hpp"
#include "tests/support/sorting.hpp"

namespace hiac::test {
namespace {

using testing::UnorderedElementsAre;
using CellSet = std::set<CellId>;

std::vector<CellSet> groups_of(const VisibilityOrder& order) {
  std::vector<CellSet> groups;
  for (const CellGroup& group : order.groups) {
    const auto cells = order.cells.view().subspan(group.first, group.count);
    groups.emplace_back(cells.begin(), cells.end());
  }
  return groups;
}

CellSet cells_from(CellId first, CellId count) {
  CellSet cells;
  for (CellId cell = first; cell < first + count; ++cell) cells.insert(cell);
  return cells;
}

ZooMesh ring(int n, double radius, const Position& center) {
  return moved(ring_of_sticks(n, 1), [&](const Position& p) {
    return Position{center[0] + radius * p[0], center[1] + radius * p[1],
                    center[2] + radius * p[2]};
  });
}

// What looks down the z axis at a square of the given height about a point.
Scene scene_above(Projection projection, const Position& center, double height,
                  std::uint32_t pixels) {
  constexpr double kDistance = 12;
  Scene scene;
  scene.image = {pixels, pixels};
  scene.camera.projection = projection;
  scene.camera.eye = {center[0], center[1], center[2] + kDistance};
  scene.camera.look_at = center;
  scene.camera.up = {0.137, 1, 0};  // no plane of a lattice goes through centres of pixels
  scene.camera.fov = 2 * std::atan(height / 2 / kDistance) * 180 / std::numbers::pi;
  scene.camera.height = height;
  scene.volume.color =
      ColorTransfer{"f", {{0.0, {0.1, 0.2, 0.9}}, {0.45, {0.2, 0.9, 0.3}}, {1, {0.9, 0.1, 0.1}}}};
  scene.volume.extinction = ExtinctionTransfer{"f", {{0.0, {0.5}}, {0.6, {4}}, {1, {1}}}};
  scene.render.tolerance = 1e-15;
  return scene;
}

// Sorts and draws the mesh, compares every pixel with the reference, and returns the groups.
std::vector<CellSet> draw_and_compare(ZooMesh mesh, const Scene& scene) {
  add_node_field(mesh, "f", [](const Position& p) {
    return 0.5 + 0.4 * std::sin(9 * p[0] + 5 * p[1]) * std::cos(7 * p[2]);
  });
  const OrderResult result = sorted(mesh, view_of(scene.camera));
  const RenderResult drawn = render(mesh, result.order, scene, false);
  EXPECT_EQ(drawn.statistics.violations, 0U);
  EXPECT_GT(drawn.statistics.covered_pixels, 0U);
  double largest = 0;
  for (std::uint32_t y = 0; y < scene.image.height; ++y)
    for (std::uint32_t x = 0; x < scene.image.width; ++x) {
      const auto expected = reference_pixel(mesh, scene, x, y);
      for (std::size_t c = 0; c < 4; ++c)
        largest = std::max(largest, std::abs(expected[c] - drawn.image.at(x, y, c)));
    }
  EXPECT_LE(largest, 1e-12);
  return groups_of(result.order);
}

constexpr std::array kProjections{Projection::orthographic, Projection::perspective};

TEST(Cycles, RingsOfCellsAreOneGroupEach) {
  for (const int n : {3, 4, 5, 6}) {
    SCOPED_TRACE(n);
    const ZooMesh mesh = ring(n, 1, {0, 0, 0});
    for (const Projection projection : kProjections) {
      const Scene scene = scene_above(projection, {0, 0, 0}, 3, 40);
      const View view = view_of(scene.camera);
      EXPECT_TRUE(is_order_of(exact_relation(mesh, view).arrows, mesh.cell_count(),
                              sorted(mesh, view).order));
      EXPECT_THAT(draw_and_compare(mesh, scene),
                  UnorderedElementsAre(cells_from(0, static_cast<CellId>(n))));
    }
    EXPECT_TRUE(sorted(mesh, along("across", {1, 0.3, 0}).view).order.groups.empty());
  }
}

// A ring of three in the cavity of a mesh of more than ten thousand cells: a group of three.
TEST(Cycles, ThreeCellsInsideABigMesh) {
  constexpr std::size_t kCubes = 13;
  const ZooMesh shell =
      keep_cells(structured(kCubes, Cut::tetrahedra), [](const Position& p, CellId) {
        return std::ranges::any_of(p, [](double x) { return std::abs(x - 0.5) > 2.5 / kCubes; });
      });
  const Position middle{0.5, 0.5, 0.5};
  const ZooMesh mesh = side_by_side(shell, ring(3, 0.12, middle));
  const auto first = static_cast<CellId>(shell.cell_count());
  ASSERT_GT(first, 10000U);
  for (const Projection projection : kProjections)
    EXPECT_THAT(draw_and_compare(mesh, scene_above(projection, middle, 0.45, 14)),
                UnorderedElementsAre(cells_from(first, 3)));
  // from inside the cavity: above the ring, and in its middle, where it is no cycle
  const VisibilityOrder inside = sorted(mesh, from_eye("", {0.5, 0.5, 0.65}).view).order;
  EXPECT_THAT(groups_of(inside), UnorderedElementsAre(cells_from(first, 3)));
  EXPECT_TRUE(sorted(mesh, from_eye("", middle).view).order.groups.empty());
  EXPECT_TRUE(sorted(mesh, along("across", {1, 0.2, 0}).view).order.groups.empty());
}

TEST(Cycles, SeparateCyclesAreSeparateGroups) {
  const ZooMesh three = ring(3, 0.5, {0, 0, 0});
  for (const Position& place : {Position{1.2, 0.4, -0.3}, {0.1, 0.05, -1.5}, {0, 0, 1.5}}) {
    const ZooMesh mesh = side_by_side(three, ring(6, 0.5, place));
    for (const Projection projection : kProjections)
      EXPECT_THAT(draw_and_compare(mesh, scene_above(projection, {0.4, 0.1, 0}, 3, 40)),
                  UnorderedElementsAre(cells_from(0, 3), cells_from(3, 6)));
  }
}

// Six slabs (bricks) that lean on one another in a ring.
TEST(Cycles, SixSlabs) {
  std::vector<Position> positions;
  std::vector<Cell> cells;
  for (int k = 0; k < 6; ++k) {
    const double angle = k * std::numbers::pi / 3, c = std::cos(angle), s = std::sin(angle);
    Cell brick{CellKind::brick8, {}};
    for (const auto& [x, y, z] : {Position{0, 0, 0},
                                  {1, 0, 0},
                                  {1, 1, 0},
                                  {0, 1, 0},
                                  {0, 0, 1},
                                  {1, 0, 1},
                                  {1, 1, 1},
                                  {0, 1, 1}}) {
      const double along_it = 3.2 * x - 1.6, across = 0.25 * y + 1.6, depth = 2 * x + 0.1 * z;
      brick.nodes.push_back(static_cast<NodeId>(positions.size()));
      positions.push_back({c * along_it - s * across, s * along_it + c * across, depth});
    }
    cells.push_back(brick);
  }
  const ZooMesh mesh = make_mesh(positions, cells);
  const View view = along("", {0, 0, 1}).view;
  const OrderResult result = sorted(mesh, view);
  EXPECT_THAT(groups_of(result.order), UnorderedElementsAre(cells_from(0, 6)));
  EXPECT_TRUE(is_order_of(exact_relation(mesh, view).arrows, 6, result.order));
  EXPECT_TRUE(sorted(mesh, along("", {1, 0, 0}).view).order.groups.empty());
}

// No Delaunay triangulation has a cycle from anywhere (H. Edelsbrunner, 1990).
TEST(Cycles, NoneInDelaunay) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const ZooMesh mesh = random_delaunay(1500, seed);
    for (const auto& [name, view] : special_views(mesh, seed)) {
      SCOPED_TRACE(name);
      const OrderResult result = sorted(mesh, view);
      EXPECT_EQ(result.statistics.largest_group, 1U);
      EXPECT_TRUE(result.order.groups.empty());
    }
  }
}

// The arrows across shared faces of bricks, positively oriented, with any four corners: the signs
// of (P - e) . (P_u x P_v) at corners and at points between them, in rational arithmetic.
Arrows patch_arrows(const ZooMesh& mesh, const View& view) {
  constexpr int kSteps = 2;
  std::map<std::set<NodeId>, std::vector<CellId>> cells_at;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    for (const ShapeFace& face : topology_of(CellShape::brick).faces) {
      CellSet nodes;
      for (const auto corner : face.corners) nodes.insert(mesh.cell_nodes(cell)[corner]);
      cells_at[nodes].push_back(cell);
    }
  Arrows arrows;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    for (const ShapeFace& face : topology_of(CellShape::brick).faces) {
      CellSet nodes;
      std::array<RationalVector, 4> p;
      for (std::size_t k = 0; k < 4; ++k) {
        const NodeId node = mesh.cell_nodes(cell)[face.corners[k]];
        nodes.insert(node);
        const auto x = mesh.position(node);
        p[k] = rational({x[0], x[1], x[2]});
      }
      const auto& sharing = cells_at[nodes];
      if (sharing.size() != 2) continue;
      const CellId other = sharing[0] == cell ? sharing[1] : sharing[0];
      for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; j <= kSteps; ++j) {
          const mpq_class u(i, kSteps), v(j, kSteps);
          RationalVector ray, pu, pv;
          for (std::size_t c = 0; c < 3; ++c) {
            pu[c] = (1 - v) * (p[1][c] - p[0][c]) + v * (p[2][c] - p[3][c]);
            pv[c] = (1 - u) * (p[3][c] - p[0][c]) + u * (p[2][c] - p[1][c]);
            ray[c] = view.direction[c];
            if (view.perspective)
              ray[c] = p[0][c] + u * (p[1][c] - p[0][c]) + v * pv[c] - mpq_class(view.eye[c]);
          }
          const int leaves = sgn(determinant(ray, pu, pv));
          if (leaves > 0) arrows.emplace_back(cell, other);
          if (leaves < 0) arrows.emplace_back(other, cell);
        }
    }
  return arrows;
}

// Groups of bricks with warped faces are what crosses them both ways, and no more.
TEST(Cycles, JitteredBricksAreGroupedWhereRaysCrossBothWays) {
  std::size_t grouped = 0, alone = 0;
  for (const double amplitude : {0.05, 0.3}) {
    SCOPED_TRACE(amplitude);
    const ZooMesh mesh = jittered_bricks(3, amplitude, 5);
    for (const auto& [name, view] : special_views(mesh, 3)) {
      SCOPED_TRACE(name);
      const OrderResult result = sorted(mesh, view);
      ASSERT_TRUE(is_order_of(patch_arrows(mesh, view), mesh.cell_count(), result.order));
      grouped += result.statistics.cells_in_groups;
      alone += mesh.cell_count() - result.statistics.cells_in_groups;
    }
  }
  EXPECT_GT(grouped, tried(100));
  EXPECT_GT(alone, tried(160));
}

// The table of docs/visibility-order.md: the percentage of cells in groups, and the largest group.
struct Share {
  double percent;
  std::uint64_t largest;
};

TEST(Cycles, SharesOfJitteredBricksInGroups) {
  const std::array views{from_eye("corner", {3.1, 2.3, 2.7}), from_eye("front", {0.5, 0.5, 4}),
                         from_eye("inside", {0.52, 0.47, 0.55}), along("z", {0, 0, 1}),
                         along("diagonal", {-2.6, -1.8, -2.2})};
  struct Row {
    double amplitude;
    std::array<Share, 5> shares;
  };
  const std::vector<Row> table{
      {0.0, {{{0.0, 1}, {0.0, 1}, {0.0, 1}, {0.0, 1}, {0.0, 1}}}},
      {1e-12, {{{0.0, 1}, {0.0, 1}, {0.0, 1}, {0.0, 1}, {0.0, 1}}}},
      {1e-6, {{{0.0, 1}, {10.0, 4}, {5.5, 2}, {97.7, 391}, {0.0, 1}}}},
      {0.01, {{{0.0, 1}, {12.6, 9}, {5.4, 2}, {97.7, 391}, {0.0, 1}}}},
      {0.05, {{{0.0, 1}, {51.0, 63}, {13.7, 4}, {97.8, 393}, {0.0, 1}}}},
      {0.1, {{{0.0, 1}, {84.5, 271}, {24.5, 15}, {98.0, 395}, {0.0, 1}}}},
      {0.2, {{{3.9, 3}, {97.0, 381}, {45.7, 41}, {98.4, 397}, {2.8, 3}}}},
      {0.3, {{{37.0, 22}, {99.1, 1535}, {69.8, 156}, {99.3, 2399}, {34.4, 27}}}},
  };
  for (const auto& [amplitude, shares] : table) {
    SCOPED_TRACE(amplitude);
    const ZooMesh mesh = jittered_bricks(20, amplitude, 1);
    for (std::size_t i = 0; i < views.size(); ++i) {
      SCOPED_TRACE(views[i].name);
      const OrderStatistics found = sorted(mesh, views[i].view).statistics;
      const double percent = 100.0 * static_cast<double>(found.cells_in_groups) /
                             static_cast<double>(mesh.cell_count());
      EXPECT_NEAR(percent, shares[i].percent, 0.06);
      EXPECT_EQ(found.largest_group, shares[i].largest);
    }
  }
}

}  // namespace
}  // namespace hiac::test
