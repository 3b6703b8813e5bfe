#include "hiac/frame/tiles/finished_tile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/base/special_values.hpp"
#include "hiac/frame/background.hpp"

namespace hiac {
namespace {

// The value of one channel of a finished pixel. `background`: the largest channel behind it.
double channel_value(Channel channel, const Projector& projector, DrawnTile& tile, std::size_t at,
                     double background) {
  const PixelFacts& pixel = tile.facts(at);
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

}  // namespace

void TileSummary::add_pixel(double transparency, double surfaces) {
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

TileSummary write_tile(DrawnTile& drawn, const TileRect& tile, const Projector& projector,
                       const Scene& scene, const PictureParts& wanted, Image& image) {
  TileSummary summary{.counts = drawn.counts()};
  const TilePixels& pixels = drawn.pixels();
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
            channel_value(wanted.channels[c], projector, drawn, at, std::ranges::max(behind));
      if (pixels.last[at] != -std::numeric_limits<double>::infinity())
        summary.add_pixel(transparency, drawn.surface_transparency(at));
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

FinishedTile finish_tile(DrawnTile& drawn, const TileRect& tile, const Projector& projector,
                         const Scene& scene, const PictureParts& wanted) {
  const PixelRect rect = common_pixels(tile, wanted.part);
  Image image(rect.width, rect.height, image_channels(wanted.channels));
  const PictureParts here{rect, wanted.with_background, wanted.channels};
  const TileSummary summary = write_tile(drawn, tile, projector, scene, here, image);
  return {summary, {image.values().begin(), image.values().end()}};
}

void put_tile(const FinishedTile& finished, const TileRect& tile, const PixelRect& part,
              Image& image) {
  const PixelRect rect = common_pixels(tile, part);
  const std::size_t row = rect.width * image.channel_count();
  for (std::uint32_t y = 0; y < rect.height; ++y)
    std::copy_n(finished.values.begin() + static_cast<std::ptrdiff_t>(y * row), row,
                image.pixel(rect.x - part.x, rect.y - part.y + y).data());
}

PixelRect common_pixels(const TileRect& tile, const PixelRect& part) {
  const auto low = [](int begin, std::uint32_t other) {
    return std::max(static_cast<std::uint32_t>(begin), other);
  };
  const auto high = [](int end, std::uint32_t other) {
    return std::min(static_cast<std::uint32_t>(end), other);
  };
  const std::uint32_t x = low(tile.x0, part.x), y = low(tile.y0, part.y);
  return {x, y, high(tile.x1, part.x + part.width) - x, high(tile.y1, part.y + part.height) - y};
}

}  // namespace hiac
