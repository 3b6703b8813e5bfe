// Parts behind opaque ones: they are left undrawn, and nothing of the picture depends on that.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/cluster/parted_renderer.hpp"
#include "hiac/cluster/parted_round.hpp"
#include "hiac/frame/tiles/finished_tile.hpp"
#include "hiac/render/runs/merged_tile.hpp"
#include "hiac/render/runs/part_engine.hpp"
#include "hiac/render/runs/runs_by_depth.hpp"
#include "tests/cluster/parts_of.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using test::Cut;

constexpr TileRect kTile{0, 0, 5, 3};
constexpr double kLeast = 1e-3;
constexpr double kNever = std::numeric_limits<double>::infinity();

// A view into a cube that fills the picture, in which the light ends within about a third.
Scene opaque_scene(Projection projection) {
  Scene scene = test::kInstrumented ? test::cube_scene(projection, 200, 140)
                                    : test::cube_scene(projection, 330, 270);
  scene.camera.eye = {0.55, 0.45, 1.9};
  scene.camera.look_at = {0.5, 0.5, 0.5};
  scene.camera.up = {0, 1, 0};
  scene.camera.fov = 25;
  scene.camera.height = 0.6;
  scene.volume.extinction->points = {{0, {60}}, {1, {90}}};
  scene.render.tolerance = 1e-9;
  return scene;
}

ZooMesh cube() {
  ZooMesh mesh = test::structured(test::kInstrumented ? 4 : 8, Cut::tetrahedra);
  test::add_node_field(mesh, "f", test::smooth_field);
  return mesh;
}

// Slabs across the view, the one that lies farthest from the eye first.
std::vector<std::uint32_t> slabs(const ZooMesh& mesh, std::uint32_t count) {
  std::vector<std::uint32_t> parts;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    double z = 0;
    for (const NodeId node : mesh.cell_nodes(cell)) z += mesh.position(node)[2] / 4;
    parts.push_back(static_cast<std::uint32_t>(z * count));
  }
  return parts;
}

struct Drawn {
  RenderResult result;
  std::uint64_t segments = 0;  // that all processes drew
  std::uint64_t rounds = 0;
};

Drawn draw_by_ranks(const test::Parts& parts, const Scene& scene, std::uint32_t ranks,
                    std::span<const Channel> channels) {
  Drawn drawn;
  std::vector<std::uint64_t> segments(ranks);
  test::run_ranks(ranks, [&](Communicator& all) {
    PartedRenderer renderer(all, parts.of_rank(all.rank(), ranks), scene, channels);
    RenderResult own = renderer.render(whole_picture(scene.image), true);
    segments[all.rank()] = renderer.work().segments;
    if (all.rank() != 0) return;
    drawn.result = std::move(own);
    drawn.rounds = renderer.work().rounds;
  });
  for (const std::uint64_t own : segments) drawn.segments += own;
  return drawn;
}

// Every part drawn in every tile, and all their runs merged; the segments that were drawn.
std::pair<Image, std::uint64_t> all_parts_drawn(const test::Parts& parts, const Scene& scene,
                                                std::span<const Channel> channels) {
  const std::vector<DrawnPart> all = parts.of_rank(0, 1);
  std::vector<std::unique_ptr<PartEngine>> engines;
  MeshExtremes extremes;
  for (const DrawnPart& part : all) {
    engines.push_back(std::make_unique<PartEngine>(part.mesh, scene, channels));
    extremes.add(engines.back()->extremes());
  }
  for (const auto& engine : engines) engine->set_whole(extremes);
  const PixelRect picture = whole_picture(scene.image);
  std::vector<TileBins> bins;
  for (std::size_t k = 0; k < all.size(); ++k)
    bins.push_back(engines[k]->bins(all[k].order, picture));
  Image image(scene.image.width, scene.image.height, image_channels(channels));
  const Projector projector(scene.camera, scene.image);
  const PictureParts wanted{picture, true, channels};
  const std::vector<TileRect> tiles = tiles_of(scene.image, picture);
  std::uint64_t segments = 0;
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    std::vector<TileRuns> runs;
    for (std::size_t k = 0; k < all.size(); ++k) {
      runs.push_back(engines[k]->draw(all[k].order, tiles[t], bins[k].cells_of(t)));
      segments += runs.back().counts.segments;
    }
    MergedTile merged(engines[0]->constants(), runs);
    write_tile(merged, tiles[t], projector, scene, wanted, image);
  }
  return {std::move(image), segments};
}

TEST(HiddenParts, AreNotDrawnAndChangeNoBit) {
  const ZooMesh mesh = cube();
  for (const Projection projection :
       test::tried(std::vector{Projection::perspective, Projection::orthographic})) {
    const Scene scene = opaque_scene(projection);
    const test::Parts parts(mesh, slabs(mesh, 8), 8, scene);
    for (const char* names : test::tried(std::vector{"depth,transparency,cells,error", ""})) {
      const std::vector<Channel> channels = parse_channels(names);
      const auto [image, all_segments] = all_parts_drawn(parts, scene, channels);
      const Drawn alone = draw_by_ranks(parts, scene, 1, channels);
      EXPECT_TRUE(test::same_bits(alone.result.image, image));
      // all of the first round, then half of the slabs or fewer
      EXPECT_LT(alone.segments, all_segments * (test::kInstrumented ? 99 : 75) / 100);
      EXPECT_LE(alone.result.statistics.segments, alone.segments);
      EXPECT_GT(alone.result.statistics.segments, 0U);
      for (const std::uint32_t ranks : test::tried(std::vector{3U, 2U, 8U})) {
        const Drawn drawn = draw_by_ranks(parts, scene, ranks, channels);
        EXPECT_TRUE(test::same_bits(drawn.result.image, image)) << ranks;
        EXPECT_EQ(drawn.segments, alone.segments) << ranks;
        EXPECT_EQ(drawn.result.statistics.segments, alone.result.statistics.segments) << ranks;
        EXPECT_EQ(drawn.result.statistics.violations, 0U);
      }
    }
  }
}

TEST(HiddenParts, AreFoundInPartsOfThePictureToo) {
  const ZooMesh mesh = cube();
  const Scene scene = opaque_scene(Projection::perspective);
  const test::Parts parts(mesh, slabs(mesh, 4), 4, scene);
  const auto [image, all_segments] = all_parts_drawn(parts, scene, {});
  test::run_ranks(2, [&](Communicator& all) {
    PartedRenderer renderer(all, parts.of_rank(all.rank(), 2), scene);
    for (const PixelRect& rect : {PixelRect{0, 0, scene.image.width, 100},
                                  PixelRect{0, 100, scene.image.width, scene.image.height - 100}}) {
      const RenderResult half = renderer.render(rect, true);
      if (all.rank() != 0) continue;
      for (std::uint32_t y = 0; y < rect.height; ++y)
        for (std::uint32_t x = 0; x < rect.width; ++x)
          for (std::size_t c = 0; c < 4; ++c)
            ASSERT_EQ(half.image.at(x, y, c), image.at(rect.x + x, rect.y + y, c));
    }
  });
}

// Where nothing is opaque, all is drawn, in as few rounds as before.
TEST(HiddenParts, TransparentPartsAreDrawnAtOnce) {
  const ZooMesh mesh = cube();
  Scene scene = opaque_scene(Projection::perspective);
  scene.volume.extinction->points = {{0, {2}}, {1, {3}}};
  const test::Parts parts(mesh, slabs(mesh, 8), 8, scene);
  const auto [image, all_segments] = all_parts_drawn(parts, scene, {});
  const Drawn drawn = draw_by_ranks(parts, scene, 2, {});
  EXPECT_TRUE(test::same_bits(drawn.result.image, image));
  EXPECT_EQ(drawn.segments, all_segments);
  EXPECT_EQ(drawn.result.statistics.segments, all_segments);
  EXPECT_LE(drawn.rounds, 3U);
}

// No run begins before the nearest point of its cells, which is that of their nodes if they are
// linear.
TEST(HiddenParts, BeginNoNearerThanTold) {
  for (const CellKind kind : test::tried(test::all_kinds()))
    for (const bool curved : {false, true}) {
      ZooMesh mesh = curved ? test::curved_mesh(kind) : test::straight_mesh(kind, 2);
      test::add_node_field(mesh, "f", test::smooth_field);
      for (const Projection projection :
           test::tried(std::vector{Projection::perspective, Projection::orthographic})) {
        SCOPED_TRACE(testing::Message() << static_cast<int>(kind) << curved);
        const Scene scene = test::cube_scene(projection, 50, 35);
        PartEngine engine(mesh, scene, {});
        engine.set_whole(engine.extremes());
        const VisibilityOrder order = test::sorted(mesh, scene);
        const TileBins bins = engine.bins(order, whole_picture(scene.image));
        const Projector projector(scene.camera, scene.image);
        for (std::size_t t = 0; t < bins.tiles.size(); ++t) {
          const auto cells = bins.cells_of(t);
          const double told = engine.nearest(order, cells);
          double node = kNever;
          for (const std::uint32_t rank : cells)
            for (const NodeId n : mesh.cell_nodes(order.cells[rank]))
              node = std::min(node, projector.parameter(mesh.position(n)));
          EXPECT_LE(told, first_entry(engine.draw(order, bins.tiles[t], cells)));
          EXPECT_LE(told, node);
          if (!curved && !cells.empty()) {
            EXPECT_GE(told, node - 1e-8);
          }
        }
      }
    }
}

// The end of a tile -------------------------------------------------------------------------------

class RandomRuns {
 public:
  explicit RandomRuns(std::uint32_t seed) : random_(seed) {}

  // Runs of a part in all pixels of the tile; equal depths are frequent.
  TileRuns part(double least_front, double most_transparency, int most_runs) {
    TileRuns runs;
    for (int y = kTile.y0; y < kTile.y1; ++y)
      for (int x = kTile.x0; x < kTile.x1; ++x) {
        const auto pixel = static_cast<std::uint32_t>(kTile.index(x, y));
        const int count = static_cast<int>(number() * (most_runs + 1));
        double front = least_front;
        for (int k = 0; k < count; ++k) {
          front += std::floor(4 * number());
          const double left = number() < 0.2 ? kLeast * number() : most_transparency * number();
          runs.runs.push_back({front, front + 1, {{1 - left, number(), number()}, left}, pixel});
        }
      }
    return runs;
  }
  double number() { return std::uniform_real_distribution<>(0, 1)(random_); }

 private:
  std::mt19937 random_;
};

const MergeConstants kConstants{kLeast, 1e-9, 1, false};

bool same_pixels(const MergedTile& a, const MergedTile& b) {
  return std::memcmp(&a.pixels(), &b.pixels(), sizeof(TilePixels)) == 0;
}

TEST(EndOfTile, IsWhereTheLastOfThePixelsEnds) {
  std::size_t ended = 0;
  for (std::uint32_t seed = 1; seed <= 300; ++seed) {
    RandomRuns random(seed);
    std::vector<TileRuns> parts;
    for (int k = 0; k < 4; ++k) parts.push_back(random.part(0, seed % 3 == 0 ? 0.9 : 0.3, 4));
    // a pixel at a time: the first run, by depth and part, that leaves no more than kLeast
    double expected = -kNever;
    for (int y = kTile.y0; y < kTile.y1; ++y)
      for (int x = kTile.x0; x < kTile.x1; ++x) {
        std::vector<RayRun> runs;
        for (const TileRuns& part : parts)
          for (const RayRun& run : part.runs)
            if (run.pixel == kTile.index(x, y)) runs.push_back(run);
        std::ranges::stable_sort(runs, {}, &RayRun::front);  // all are as long
        double left = 1, end = kNever;
        for (const RayRun& run : runs) {
          left *= run.light.transparency;
          if (left > kLeast) continue;
          end = run.front;
          break;
        }
        expected = std::max(expected, end);
      }
    const double end = end_of_tile(kTile, parts, kLeast);
    ASSERT_EQ(end, expected) << seed;
    if (end == kNever) continue;
    ++ended;
    // what begins behind it changes no pixel, whatever it is
    const MergedTile before(kConstants, parts);
    parts.push_back(random.part(std::nextafter(end, kNever), 1, 5));
    EXPECT_TRUE(same_pixels(MergedTile(kConstants, parts), before)) << seed;
    // further parts do not move it back
    parts.push_back(random.part(0, 0.9, 3));
    EXPECT_LE(end_of_tile(kTile, parts, kLeast), end) << seed;
  }
  EXPECT_GT(ended, 30U);
  EXPECT_LT(ended, 270U);
}

TEST(EndOfTile, IsNeverWhereAPixelIsEmpty) {
  RandomRuns random(5);
  std::vector<TileRuns> parts{random.part(0, kLeast, 0)};
  for (std::uint32_t x = 0; x < 5; ++x)
    for (std::uint32_t y = 0; y < 3; ++y) {
      if (x == 4 && y == 2) continue;
      const auto pixel =
          static_cast<std::uint32_t>(kTile.index(static_cast<int>(x), static_cast<int>(y)));
      parts[0].runs.push_back({1, 2, {{1, 1, 1}, 0}, pixel});
    }
  EXPECT_EQ(end_of_tile(kTile, parts, kLeast), kNever);
  parts[0].runs.push_back(
      {3, 4, {{1, 1, 1}, kLeast}, static_cast<std::uint32_t>(kTile.index(4, 2))});
  EXPECT_EQ(end_of_tile(kTile, parts, kLeast), 3);
}

// Parts of a tile and their layers ----------------------------------------------------------------

TEST(PartedTile, LeavesOutPartsThatBeginBehindItsEnd) {
  const auto part = [](double front, std::uint64_t segments) {
    TileRuns runs;
    runs.runs.push_back({front + 1, front + 2, {}, 7});
    runs.runs.push_back({front, front + 2, {}, 8});
    runs.counts.segments = segments;
    return runs;
  };
  PartedTile tile;
  tile.add(4, part(2.0, 1));
  tile.add(1, part(std::nextafter(2.0, 3.0), 10));
  tile.add(3, part(0.5, 100));
  tile.add(2, {});  // of no runs: it begins nowhere
  EXPECT_EQ(tile.numbers, (std::vector<std::uint32_t>{1, 2, 3, 4}));
  EXPECT_EQ(tile.runs[2].runs[1].front, 0.5);
  EXPECT_EQ(tile.drop_behind(kNever), 0U);
  EXPECT_EQ(tile.numbers.size(), 4U);
  EXPECT_EQ(tile.drop_behind(2), 10U);
  EXPECT_EQ(tile.numbers, (std::vector<std::uint32_t>{3, 4}));
  EXPECT_EQ(tile.runs[1].runs[1].front, 2);
}

TEST(PartLayers, AreByTheNearestPointsOfAllProcessesParts) {
  // part k of 10 has its nearest point at 7 k mod 10, but for two that are as near
  const auto nearest = [](std::uint32_t k) { return k == 4 ? 7.0 : 7 * k % 10; };
  test::run_ranks(3, [&](Communicator& all) {
    std::vector<PartDepth> own;
    for (std::uint32_t k = all.rank(); k < 10; k += 3) own.push_back({k, nearest(k)});
    const auto layers = layers_of(all, own, 4);
    ASSERT_EQ(layers.size(), own.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
      std::uint32_t before = 0;
      for (std::uint32_t k = 0; k < 10; ++k)
        before += std::pair(nearest(k), k) < std::pair(own[i].nearest, own[i].number) ? 1 : 0;
      EXPECT_EQ(layers[i], before * 4 / 10) << own[i].number;
    }
  });
}

}  // namespace
}  // namespace hiac
