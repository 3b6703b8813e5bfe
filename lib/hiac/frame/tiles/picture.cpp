#include "hiac/frame/tiles/picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "hiac/base/parallel.hpp"
#include "hiac/base/seconds.hpp"
#include "hiac/frame/background.hpp"
#include "hiac/frame/tiles/surface_cover.hpp"

namespace hiac {
namespace {

// The value of one channel of a finished pixel. `background`: the largest channel behind it.
double channel_value(Channel channel, const Projector& projector, DrawnTile& tile, std::size_t at,
                     double background) {
  const PixelFacts& pixel = tile.facts(at);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  switch (channel) {
    case Channel::depth:
      return projector.distance(pixel.first);
    case Channel::mean_depth:
      return pixel.weight > 0 ? projector.distance(pixel.weighted_depth / pixel.weight) : kInfinity;
    case Channel::transparency:
      return tile.pixels().transparency[at];
    case Channel::cells:
      return pixel.cells;
    case Channel::witness:
      return pixel.violations;
    case Channel::error:
      break;
  }
  const double error = tile.error(at, background);
  return std::isnan(error) ? kInfinity : error;  // the bound is unknown
}

// The results of a tile besides its pixels.
struct TileSummary {
  TileCounts counts;
  double optical_depth_sum = 0, optical_depth_most = 0;
  std::uint64_t covered = 0, with_depth = 0;

  // `surfaces`: the transparency of skin and edges alone.
  void add_pixel(double transparency, double surfaces) {
    constexpr double kLeast = 1e-3;      // what hides the medium does not tell its depth
    constexpr double kRounding = 1e-14;  // of two products
    ++covered;
    if (surfaces < kLeast) return;
    const double depth =
        -std::log(std::max(transparency / surfaces, std::numeric_limits<double>::min()));
    if (surfaces < 1 && depth <= kRounding) return;
    optical_depth_sum += depth;
    optical_depth_most = std::max(optical_depth_most, depth);
    ++with_depth;
  }
};

// Writes the pixels of a tile that lie in the part of the picture shown by the image.
TileSummary write_tile(DrawnTile& drawn, const TileRect& tile, const Frame& frame,
                       const Scene& scene, const PictureParts& wanted, Image& image) {
  TileSummary summary{.counts = drawn.counts()};
  const TilePixels& pixels = drawn.pixels();
  const auto* cover = dynamic_cast<const SurfaceCover*>(&drawn);
  const PixelRect& part = wanted.part;
  const int left = static_cast<int>(part.x), top = static_cast<int>(part.y);
  const int x0 = std::max(tile.x0, left), y0 = std::max(tile.y0, top);
  const int x1 = std::min(tile.x1, left + static_cast<int>(part.width));
  const int y1 = std::min(tile.y1, top + static_cast<int>(part.height));
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const std::size_t at = tile.index(x, y);
      const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
      const double transparency = pixels.transparency[at];
      const auto pixel = image.pixel(column - part.x, row - part.y);
      const Color behind = wanted.with_background
                               ? background_at(scene.background, scene.image, column, row)
                               : Color{};
      pixel[0] = pixels.red[at] + transparency * behind[0];
      pixel[1] = pixels.green[at] + transparency * behind[1];
      pixel[2] = pixels.blue[at] + transparency * behind[2];
      pixel[3] = 1 - transparency;
      for (std::size_t c = 0; c < wanted.channels.size(); ++c)
        pixel[4 + c] =
            channel_value(wanted.channels[c], frame.projector, drawn, at, std::ranges::max(behind));
      if (pixels.last[at] != -std::numeric_limits<double>::infinity())
        summary.add_pixel(transparency, cover == nullptr ? 1 : cover->surface_transparency(at));
    }
  }
  return summary;
}

RenderStatistics statistics_of(std::span<const TileSummary> tiles) {
  RenderStatistics statistics;
  for (const TileSummary& tile : tiles) {
    statistics.segments += tile.counts.segments;
    statistics.violations += tile.counts.violations;
    statistics.covered_pixels += tile.covered;
    statistics.depth_pixels += tile.with_depth;
    statistics.mean_optical_depth += tile.optical_depth_sum;
    statistics.largest_optical_depth =
        std::max(statistics.largest_optical_depth, tile.optical_depth_most);
  }
  if (statistics.depth_pixels > 0)
    statistics.mean_optical_depth /= static_cast<double>(statistics.depth_pixels);
  return statistics;
}

}  // namespace

RenderStatistics& RenderStatistics::operator+=(const RenderStatistics& other) {
  segments += other.segments;
  violations += other.violations;
  const auto pixels = static_cast<double>(depth_pixels),
             more = static_cast<double>(other.depth_pixels);
  if (more > 0)
    mean_optical_depth =
        (mean_optical_depth * pixels + other.mean_optical_depth * more) / (pixels + more);
  largest_optical_depth = std::max(largest_optical_depth, other.largest_optical_depth);
  covered_pixels += other.covered_pixels;
  depth_pixels += other.depth_pixels;
  splatted_cells = std::max(splatted_cells, other.splatted_cells);
  prepare_seconds += other.prepare_seconds;
  tile_seconds += other.tile_seconds;
  return *this;
}

Details details_for(std::span<const Channel> channels) {
  if (channels.empty()) return Details::none;
  return std::ranges::find(channels, Channel::error) == channels.end() ? Details::described
                                                                       : Details::bounded;
}

RenderResult draw_picture(const Frame& frame, const Scene& scene, const TileBins& bins,
                          const PictureParts& wanted, const DrawTile& draw, Progress* progress) {
  const double start = seconds_now();
  Image image(wanted.part.width, wanted.part.height, image_channels(wanted.channels));
  if (progress != nullptr) progress->begin("tiles", bins.tiles.size());
  std::vector<TileSummary> summaries(bins.tiles.size());
  parallel_for(bins.tiles.size(), 1, [&](IndexRange range) {
    const std::size_t tile = range.begin;
    draw(bins.tiles[tile], bins.cells_of(tile), [&](DrawnTile& drawn) {
      summaries[tile] = write_tile(drawn, bins.tiles[tile], frame, scene, wanted, image);
    });
    if (progress != nullptr) progress->advance();
  });
  RenderStatistics statistics = statistics_of(summaries);
  statistics.tile_seconds = seconds_now() - start;
  return {std::move(image), statistics};
}

}  // namespace hiac
