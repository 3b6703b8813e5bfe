#include "hiac/order/published/screen_extents.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/order/published/sorting_tiles.hpp"
#include "tests/order/order_meshes.hpp"

namespace hiac::test {
namespace {

bool meet(const ScreenExtent& a, const ScreenExtent& b) {
  return a.x_low <= b.x_high && b.x_low <= a.x_high && a.y_low <= b.y_high && b.y_low <= a.y_high &&
         a.sum_low <= b.sum_high && b.sum_low <= a.sum_high &&
         a.difference_low <= b.difference_high && b.difference_low <= a.difference_high;
}

bool meet_in_a_window(const std::vector<WindowCells>& windows, std::uint32_t a, std::uint32_t b) {
  return std::ranges::any_of(windows, [&](const WindowCells& window) {
    const auto& ranks = window.ranks;
    const auto i = std::ranges::find(ranks, a), j = std::ranges::find(ranks, b);
    return i != ranks.end() && j != ranks.end() &&
           meet(window.extents[static_cast<std::size_t>(i - ranks.begin())],
                window.extents[static_cast<std::size_t>(j - ranks.begin())]);
  });
}

Position random_point(const ZooMesh& mesh, CellId cell, std::mt19937_64& random) {
  std::exponential_distribution<double> weight;
  Position point{};
  double sum = 0;
  for (const NodeId node : mesh.cell_nodes(cell)) {
    const double w = weight(random);
    sum += w;
    for (std::size_t c = 0; c < 3; ++c) point[c] += w * mesh.position(node)[c];
  }
  for (double& x : point) x /= sum;
  return point;
}

// Two tetrahedra, one of which is moved along rays so that one ray meets both: in some window their
// extents meet.
TEST(ScreenExtents, CellsOnOneRayMeetInAWindow) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const auto& [name, view] : many_views()) {
    SCOPED_TRACE(name);
    for (int i = 0; i < 200; ++i) {
      std::vector<Position> positions;
      for (int k = 0; k < 8; ++k) positions.push_back({unit(random), unit(random), unit(random)});
      const std::vector<Cell> cells{{CellKind::tetrahedron4, {0, 1, 2, 3}},
                                    {CellKind::tetrahedron4, {4, 5, 6, 7}}};
      const ZooMesh apart = make_mesh(positions, cells);
      const Position p = random_point(apart, 0, random), q = random_point(apart, 1, random);
      const double along = 3 * unit(random);
      for (std::size_t k = 4; k < 8; ++k)
        for (std::size_t c = 0; c < 3; ++c)
          positions[k][c] += view.perspective ? view.eye[c] + along * (p[c] - view.eye[c]) - q[c]
                                              : p[c] + (along - 1.5) * view.direction[c] - q[c];
      const auto windows =
          screen_extents(make_mesh(positions, cells), view, std::vector<CellId>{0, 1});
      ASSERT_TRUE(meet_in_a_window(windows, 0, 1));
    }
  }
}

TEST(ScreenExtents, OneWindowBeforeTheEyeAndSixAroundIt) {
  const ZooMesh mesh = structured(2, Cut::bricks);
  std::vector<CellId> cells(mesh.cell_count());
  std::iota(cells.begin(), cells.end(), 0U);
  EXPECT_EQ(screen_extents(mesh, from_eye("outside", {3, 4, 5}).view, cells).size(), 1U);
  EXPECT_EQ(screen_extents(mesh, along("x", {1, 0, 0}).view, cells).size(), 1U);
  EXPECT_EQ(screen_extents(mesh, from_eye("inside", {0.4, 0.5, 0.6}).view, cells).size(), 6U);
}

// Along z, the window's x is the world's y and its y the other way round the world's x: both are
// scaled so that the mesh just fills the window.
TEST(ScreenExtents, OfAParallelViewAreThoseOfTheCornersInTheFittedWindow) {
  constexpr float kWider = 4e-7F;
  const ZooMesh mesh = moved(structured(2, Cut::bricks), [](const Position& p) {
    return Position{4 * p[0] + 7, 2 * p[1] - 9, p[2]};
  });
  std::vector<CellId> cells(mesh.cell_count());
  std::iota(cells.begin(), cells.end(), 0U);
  const auto windows = screen_extents(mesh, along("z", {0, 0, 3}).view, cells);
  ASSERT_EQ(windows.size(), 1U);
  ASSERT_EQ(windows[0].ranks, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  for (const CellId cell : cells) {
    const ScreenExtent& e = windows[0].extents[cell];
    const float x = cell / 2 % 2 == 0 ? -1.F : 0.F, y = cell % 2 == 0 ? 0.F : -1.F;
    EXPECT_EQ(e.x_low, x - kWider);
    EXPECT_EQ(e.x_high, x + 1 + kWider);
    EXPECT_EQ(e.y_low, y - kWider);
    EXPECT_EQ(e.y_high, y + 1 + kWider);
    EXPECT_EQ(e.sum_low, x + y - kWider);
    EXPECT_EQ(e.sum_high, x + y + 2 + kWider);
    EXPECT_EQ(e.difference_low, x - y - 1 - kWider);
    EXPECT_EQ(e.difference_high, x - y + 1 + kWider);
  }
}

// Three tetrahedra that look as large as a quarter, a half and a quarter: places are quotients by
// the depth.
TEST(ScreenExtents, InPerspectiveAreThoseOfPlacesBeforeTheEye) {
  std::vector<Position> positions;
  std::vector<Cell> cells;
  for (const auto& [depth, scale] : {std::pair{1.0, 0.25}, {2.0, 1.0}, {4.0, 1.0}}) {
    Cell cell{CellKind::tetrahedron4, {}};
    for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {0.0, 1.0}, {0.5, 0.0}}) {
      cell.nodes.push_back(static_cast<NodeId>(positions.size()));
      positions.push_back({5 + scale * x, 6 + scale * y, 7 + depth});
    }
    cells.push_back(cell);
  }
  // its middle is straight ahead of the eye
  const auto windows = screen_extents(make_mesh(positions, cells), from_eye("eye", {5, 6, 7}).view,
                                      std::vector<CellId>{2, 0, 1});
  ASSERT_EQ(windows.size(), 1U);
  const std::vector<double> sizes{0.5, 0.5, 1};  // of cells 2, 0 and 1, in the fitted window
  for (std::size_t rank = 0; rank < 3; ++rank) {
    const ScreenExtent& e = windows[0].extents[rank];
    const double size = sizes[rank];
    EXPECT_NEAR(e.x_low, -size, 1e-6);
    EXPECT_NEAR(e.x_high, size, 1e-6);
    EXPECT_NEAR(e.y_low, -size, 1e-6);
    EXPECT_NEAR(e.y_high, size, 1e-6);
    // x is y and y is -x: of (-1, -1), (1, -1), (0, 1) and (0.5, 0)
    EXPECT_NEAR(e.sum_low, -2 * size, 1e-6);
    EXPECT_NEAR(e.sum_high, size, 1e-6);
    EXPECT_NEAR(e.difference_low, -2 * size, 1e-6);
    EXPECT_NEAR(e.difference_high, size, 1e-6);
  }
}

// Around the eye, a window sees the cells that are not beside one of its sides.
TEST(ScreenExtents, WindowsAroundTheEyeSeeWhatIsNotBesideThem) {
  std::vector<Position> positions;
  std::vector<Cell> cells;
  for (std::size_t c = 0; c < 3; ++c)
    for (const double sign : {-1.0, 1.0}) {
      Cell cell{CellKind::tetrahedron4, {}};
      for (std::size_t k = 0; k < 4; ++k) {
        Position p{0.25, 0.5, 0.75};
        p[c] += sign * (k == 3 ? 1.5 : 1);
        p[(c + 1) % 3] += k == 1 ? 0.2 : -0.1;
        p[(c + 2) % 3] += k == 2 ? 0.2 : -0.1;
        cell.nodes.push_back(static_cast<NodeId>(positions.size()));
        positions.push_back(p);
      }
      cells.push_back(cell);
    }
  const std::vector<CellId> ids{0, 1, 2, 3, 4, 5};
  const auto windows =
      screen_extents(make_mesh(positions, cells), from_eye("eye", {0.25, 0.5, 0.75}).view, ids);
  ASSERT_EQ(windows.size(), 6U);
  for (std::uint32_t w = 0; w < 6; ++w) {
    ASSERT_EQ(windows[w].ranks, std::vector<std::uint32_t>{w});
    const ScreenExtent& e = windows[w].extents[0];
    for (const float low : {e.x_low, e.y_low}) EXPECT_TRUE(low > -0.21F && low < -0.09F);
    for (const float high : {e.x_high, e.y_high}) EXPECT_TRUE(high > 0.09F && high < 0.21F);
  }
}

// Every pair that meets is paired in one tile, and its cells are in the tiles' lists by rank.
TEST(SortingTiles, PairEveryTwoCellsThatMeetOnce) {
  const ZooMesh mesh = random_delaunay(20, 3);
  std::vector<CellId> cells(mesh.cell_count());
  std::iota(cells.begin(), cells.end(), 0U);
  const auto windows = screen_extents(mesh, from_eye("outside", {3, 2, 5}).view, cells);
  const auto& extents = windows[0].extents;
  for (const TilingOptions& tiling :
       {TilingOptions{1, 1, false}, TilingOptions{}, TilingOptions{3, 5, true},
        TilingOptions{5, 3, false}, TilingOptions{50, 60, true}}) {
    const SortingTiles tiles = sorting_tiles(windows, mesh.cell_count(), tiling);
    std::vector<int> paired(cells.size() * cells.size(), 0);
    for (std::size_t tile = 0; tile < tiles.tile_count(); ++tile)
      for (std::size_t a = tiles.start[tile]; a < tiles.start[tile + 1]; ++a)
        for (std::size_t b = tiles.start[tile]; b < a; ++b) {
          ASSERT_LT(tiles.ranks[b], tiles.ranks[a]);
          if (tiles.pairs_here(a, b)) ++paired[tiles.ranks[a] * cells.size() + tiles.ranks[b]];
        }
    for (std::size_t a = 0; a < cells.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        ASSERT_LE(paired[a * cells.size() + b], 1);
        ASSERT_TRUE(paired[a * cells.size() + b] == 1 || !meet(extents[a], extents[b]));
      }
    for (std::uint32_t rank = 0; rank < cells.size(); ++rank)
      for (const std::size_t place : tiles.places(rank)) ASSERT_EQ(tiles.ranks[place], rank);
  }
}

TEST(SortingTiles, BalancedTilesHoldEquallyManyCells) {
  const ZooMesh mesh = moved(random_delaunay(400, 3), [](const Position& p) {
    return Position{p[0] * p[0] * p[0], p[1], p[2]};
  });
  std::vector<CellId> cells(mesh.cell_count());
  std::iota(cells.begin(), cells.end(), 0U);
  const auto windows = screen_extents(mesh, along("z", {0, 0, 1}).view, cells);
  const auto largest = [&](bool balanced) {
    const SortingTiles tiles = sorting_tiles(windows, cells.size(), {6, 6, balanced});
    std::size_t most = 0;
    for (std::size_t tile = 0; tile < tiles.tile_count(); ++tile)
      most = std::max(most, tiles.start[tile + 1] - tiles.start[tile]);
    return most;
  };
  EXPECT_LT(3 * largest(true), 2 * largest(false));
}

}  // namespace
}  // namespace hiac::test
