#include "hiac/render/walk/walked_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "hiac/base/cancellation.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/base/seconds.hpp"
#include "hiac/frame/tiles/finished_tile.hpp"
#include "hiac/frame/tiles/tile_bins.hpp"
#include "hiac/render/edges/tile_edges.hpp"
#include "hiac/render/walk/ray_walk.hpp"

namespace hiac {
namespace {

// A tile whose rays have been followed.
class WalkedTile : public DrawnTile {
 public:
  WalkedTile(const RayScene& scene, const RayStarts& starts, const TileRect& tile)
      : edges_(scene.frame, scene.edges, tile) {
    buffer_.reset(tile, scene.frame.projector, false);
    follow_rays(scene, starts, {scene.frame, tile, buffer_, nullptr, counts_}, edges_);
    if (edges_.empty()) return;
    SegmentList beside;
    edges_.append_rest({scene.frame, tile, buffer_, &beside, counts_});
    composite_sorted(beside, scene.frame.witness_tolerance, buffer_, counts_);
  }

  [[nodiscard]] const TilePixels& pixels() const override { return buffer_; }
  [[nodiscard]] const TileCounts& counts() const override { return counts_; }
  [[nodiscard]] const PixelFacts& facts(std::size_t /*at*/) const override { return none_; }
  [[nodiscard]] double surface_transparency(std::size_t at) const override {
    return edges_.transparency(at);
  }
  [[nodiscard]] double error(std::size_t /*at*/, double /*background*/) override {
    return std::numeric_limits<double>::quiet_NaN();
  }

 private:
  TileEdges edges_;
  TileBuffer buffer_;
  TileCounts counts_;
  PixelFacts none_;
};

// Rows of a tile that are drawn at a time: few pictures' pixels occupy all threads then.
constexpr int kStripRows = 16;

std::vector<TileRect> strips_of(std::span<const TileRect> tiles) {
  std::vector<TileRect> strips;
  for (const TileRect& tile : tiles)
    for (int y = tile.y0; y < tile.y1; y += kStripRows)
      strips.push_back({tile.x0, y, tile.x1, std::min(y + kStripRows, tile.y1)});
  return strips;
}

}  // namespace

bool is_faster_walked(std::size_t cells, std::uint64_t pixels) {
  constexpr double kPixelsPerCell = 64;
  return static_cast<double>(pixels) <
         kPixelsPerCell * std::pow(static_cast<double>(cells), 2.0 / 3.0);
}

std::optional<RenderResult> walked_picture(const WalkableMesh& mesh, const Scene& scene,
                                           const MeshEdges* edges, bool with_background) {
  const double start = seconds_now();
  const Projector projector(scene.camera, scene.image);
  const RayScene rays(mesh, scene, projector, edges);
  if (!rays.is_walkable()) return std::nullopt;
  const RayStarts starts(rays, scene.image);
  const double prepared = seconds_now();
  const PixelRect part = whole_picture(scene.image);
  const std::vector<TileRect> tiles = strips_of(tiles_of(scene.image, part));
  Image image(part.width, part.height, rgba_channels());
  std::vector<TileSummary> summaries(tiles.size());
  parallel_for(tiles.size(), 1, [&](IndexRange range) {
    for (std::size_t n = range.begin; n < range.end; ++n) {
      check_cancelled();
      WalkedTile tile(rays, starts, tiles[n]);
      summaries[n] = write_tile(tile, tiles[n], projector, scene, {part, with_background}, image);
    }
  });
  RenderResult result{std::move(image), statistics_of(summaries)};
  result.statistics.prepare_seconds = prepared - start;
  result.statistics.tile_seconds = seconds_now() - prepared;
  return result;
}

}  // namespace hiac
