#include "hiac/frame/tiles/tile_bins.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/parallel.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

Scene small_scene(Projection projection) {
  Scene scene;
  scene.image = {200, 150};
  scene.camera.projection = projection;
  scene.camera.eye = {3.1, 2.3, 2.7};
  scene.camera.look_at = {0.5, 0.5, 0.5};
  scene.camera.up = {0, 0, 1};
  scene.camera.height = 1.5;
  scene.camera.fov = 24;
  return scene;
}

// The tiles that hold a pixel centre of the bounding box of a cell's corners, pixel by pixel.
std::set<std::size_t> tiles_of(const ZooMesh& mesh, CellId cell, const Projector& projector,
                               const std::vector<TileRect>& tiles) {
  double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
  for (const NodeId node : mesh.cell_nodes(cell)) {
    ProjectedNode p{};
    EXPECT_TRUE(projector.project(mesh.position(node), p));
    x0 = std::min(x0, p.x), x1 = std::max(x1, p.x);
    y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
  }
  const auto holds = [](double low, double high, int begin, int end) {
    for (int k = begin; k < end; ++k)
      if (k + 0.5 >= low && k + 0.5 < high) return true;
    return false;
  };
  std::set<std::size_t> found;
  for (std::size_t t = 0; t < tiles.size(); ++t)
    if (holds(x0, x1, tiles[t].x0, tiles[t].x1) && holds(y0, y1, tiles[t].y0, tiles[t].y1))
      found.insert(t);
  return found;
}

VisibilityOrder shuffled_order(std::size_t cells) {
  std::vector<CellId> ids(cells);
  std::iota(ids.begin(), ids.end(), 0U);
  std::shuffle(ids.begin(), ids.end(), std::mt19937(7));
  return {std::move(ids), {}, "shuffled"};
}

// Enough cells for several of the parts in which the engine deals them out.
class TileBinsOfManyCells : public testing::TestWithParam<Projection> {};

TEST_P(TileBinsOfManyCells, AreThoseFoundPixelByPixel) {
  const ZooMesh mesh = test::structured(22, test::Cut::tetrahedra);
  ASSERT_GT(mesh.cell_count(), std::size_t{3} << 14);
  const Scene scene = small_scene(GetParam());
  const Projector projector(scene.camera, scene.image);
  ZooMesh with_field = mesh;
  with_field.fields.push_back(
      {"f", "", FieldLocation::node, 1, std::vector<double>(mesh.node_count(), 0.5)});
  Scene volume = scene;
  volume.volume.extinction = ExtinctionTransfer{"f", {{0.0, {0.0}}, {1.0, {1.0}}}};
  const Frame frame(with_field, volume, projector);
  const VisibilityOrder order = shuffled_order(mesh.cell_count());

  const PixelRect whole{0, 0, 200, 150};
  const TileBins bins = bin_cells(frame, order, scene.image, whole);
  ASSERT_EQ(bins.tiles.size(), 20U);
  std::vector<std::vector<std::uint32_t>> expected(bins.tiles.size());
  for (std::uint32_t rank = 0; rank < order.cells.size(); ++rank)
    for (const std::size_t tile : tiles_of(mesh, order.cells[rank], projector, bins.tiles))
      expected[tile].push_back(rank);
  for (std::size_t tile = 0; tile < bins.tiles.size(); ++tile)
    EXPECT_TRUE(std::ranges::equal(bins.cells_of(tile), expected[tile])) << "tile " << tile;

  const ThreadLimit one_thread(1);
  const TileBins again = bin_cells(frame, order, scene.image, whole);
  EXPECT_EQ(again.start, bins.start);
  EXPECT_EQ(again.ranks, bins.ranks);
}

// A mesh with a field, and its frame.
struct Framed {
  ZooMesh mesh;
  Scene scene;
  Projector projector;
  Frame frame;

  Framed(std::size_t n, const Scene& what)
      : mesh(with_field(n)),
        scene(what),
        projector(scene.camera, scene.image),
        frame(mesh, volume_of(scene), projector) {}

  static ZooMesh with_field(std::size_t n) {
    ZooMesh mesh = test::structured(n, test::Cut::tetrahedra);
    test::add_node_field(mesh, "f", test::smooth_field);
    return mesh;
  }
  static Scene volume_of(Scene scene) {
    scene.volume.extinction = ExtinctionTransfer{"f", {{0.0, {0.0}}, {1.0, {1.0}}}};
    return scene;
  }

  // The cells that some tile has.
  [[nodiscard]] std::set<CellId> binned(const BoundsOfCell& other_bounds = {}) const {
    const VisibilityOrder order = shuffled_order(mesh.cell_count());
    const TileBins bins =
        bin_cells(frame, order, scene.image, whole_picture(scene.image), other_bounds);
    std::set<CellId> cells;
    for (const std::uint32_t rank : bins.ranks) cells.insert(order.cells[rank]);
    return cells;
  }
};

TEST(TileBins, CellsOutsideTheSlabGoToNone) {
  for (const auto projection : {Projection::orthographic, Projection::perspective}) {
    Scene scene = small_scene(projection);
    const Framed whole(6, scene);
    double nearest = INFINITY, farthest = -INFINITY;
    for (NodeId node = 0; node < whole.mesh.node_count(); ++node) {
      const double t =
          whole.projector.distance(whole.projector.parameter(whole.mesh.position(node)));
      nearest = std::min(nearest, t), farthest = std::max(farthest, t);
    }
    scene.camera.clip = {
        {nearest + 0.3 * (farthest - nearest), nearest + 0.6 * (farthest - nearest)}};
    const Framed clipped(6, scene);
    const std::set<CellId> all = whole.binned(), some = clipped.binned();
    std::set<CellId> expected;
    for (const CellId cell : all) {
      double near = INFINITY, far = -INFINITY;
      for (const NodeId node : clipped.mesh.cell_nodes(cell)) {
        const double t = clipped.projector.parameter(clipped.mesh.position(node));
        near = std::min(near, t), far = std::max(far, t);
      }
      if (far >= clipped.projector.near() && near <= clipped.projector.far()) expected.insert(cell);
    }
    EXPECT_EQ(some, expected);
    EXPECT_LT(some.size(), all.size() * 9 / 10);
    EXPECT_GT(some.size(), all.size() / 4);
  }
}

TEST(TileBins, TakeOtherBoundsForACell) {
  const Framed framed(2, small_scene(Projection::orthographic));
  const VisibilityOrder order = shuffled_order(framed.mesh.cell_count());
  constexpr CellId kElsewhere = 5, kNowhere = 7;
  const TileBins bins =
      bin_cells(framed.frame, order, framed.scene.image, whole_picture(framed.scene.image),
                [](CellId cell) -> std::optional<ScreenBounds> {
                  if (cell != kElsewhere && cell != kNowhere) return std::nullopt;
                  ScreenBounds bounds;
                  bounds.include_parameter(0);
                  bounds.include(1, 1);
                  if (cell == kElsewhere) bounds.include(66, 2);  // two tiles of the first row
                  return bounds;
                });
  std::vector<std::size_t> tiles;
  for (std::size_t tile = 0; tile < bins.tiles.size(); ++tile)
    for (const std::uint32_t rank : bins.cells_of(tile)) {
      EXPECT_NE(order.cells[rank], kNowhere);
      if (order.cells[rank] == kElsewhere) tiles.push_back(tile);
    }
  EXPECT_EQ(tiles, (std::vector<std::size_t>{0, 1}));
}

INSTANTIATE_TEST_SUITE_P(Projections, TileBinsOfManyCells,
                         testing::Values(Projection::orthographic, Projection::perspective));

}  // namespace
}  // namespace hiac
