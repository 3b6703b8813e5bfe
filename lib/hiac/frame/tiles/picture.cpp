#include "hiac/frame/tiles/picture.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include "hiac/base/parallel.hpp"
#include "hiac/base/seconds.hpp"
#include "hiac/frame/tiles/finished_tile.hpp"
#include "hiac/frame/tiles/tile_crew.hpp"

namespace hiac {
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

namespace {

// Those with most cells first, so that the last tiles to be finished take little time.
std::vector<std::size_t> tiles_by_work(const TileBins& bins) {
  std::vector<std::size_t> tiles(bins.tiles.size());
  std::iota(tiles.begin(), tiles.end(), std::size_t{0});
  std::ranges::stable_sort(tiles, std::ranges::greater(),
                           [&](std::size_t tile) { return bins.cells_of(tile).size(); });
  return tiles;
}

}  // namespace

RenderResult draw_picture(const Frame& frame, const Scene& scene, const TileBins& bins,
                          const PictureParts& wanted, const DrawTile& draw, Progress* progress) {
  const double start = seconds_now();
  const bool writes = wanted.crew == nullptr || wanted.crew->writes();
  const auto black = [&] {
    return Image(wanted.part.width, wanted.part.height, image_channels(wanted.channels));
  };
  Image image = writes ? black() : Image();
  if (progress != nullptr) progress->begin("tiles", bins.tiles.size());
  std::vector<TileSummary> summaries(bins.tiles.size());
  const auto draw_tile = [&](std::size_t tile, const TakeTile& take) {
    draw(bins.tiles[tile], bins.cells_of(tile), take);
    if (progress != nullptr) progress->advance();
  };
  const auto write = [&](std::size_t tile) {
    TileSummary summary;
    draw_tile(tile, [&](DrawnTile& drawn) {
      summary = write_tile(drawn, bins.tiles[tile], frame.projector, scene, wanted, image);
    });
    return summary;
  };
  if (wanted.crew == nullptr) {
    parallel_for(bins.tiles.size(), 1,
                 [&](IndexRange range) { summaries[range.begin] = write(range.begin); });
  } else {
    const auto finish = [&](std::size_t tile) {
      if (writes) return FinishedTile{write(tile), {}};
      FinishedTile finished;
      draw_tile(tile, [&](DrawnTile& drawn) {
        finished = finish_tile(drawn, bins.tiles[tile], frame.projector, scene, wanted);
      });
      return finished;
    };
    wanted.crew->share(tiles_by_work(bins), finish, [&](std::size_t tile, FinishedTile finished) {
      summaries[tile] = finished.summary;
      if (!finished.values.empty()) put_tile(finished, bins.tiles[tile], wanted.part, image);
    });
    if (!writes) image = black();  // not before the tiles, which the others wait for
  }
  RenderStatistics statistics = statistics_of(summaries);
  statistics.tile_seconds = seconds_now() - start;
  return {std::move(image), statistics};
}

}  // namespace hiac
