#include "hiac/frame/tiles/tile_bins.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <span>
#include <utility>

#include "hiac/base/large_pages.hpp"
#include "hiac/base/parallel.hpp"

namespace hiac {
namespace {

constexpr int kWidth = static_cast<int>(kTileWidth), kHeight = static_cast<int>(kTileHeight);
constexpr std::size_t kCellsPerChunk = 1 << 14;
// The visibility order differs from the order in memory: without prefetching, most of the time
// would be spent waiting for the cells' ranges.
constexpr std::size_t kFetchAhead = 24;
// Pixels beside a cell's bounds, ample: rounding may hide skin from their rays (SkinErrors).
constexpr double kBesideSkin = 0x1p-20;

// Tiles by column and row, half open.
struct TileRange {
  int column0, row0, column1, row1;
};

// The tiles that contain columns [x0, x1) and rows [y0, y1), neither of which is empty.
TileRange tiles_between(int x0, int y0, int x1, int y1) {
  return {x0 / kWidth, y0 / kHeight, (x1 - 1) / kWidth + 1, (y1 - 1) / kHeight + 1};
}

TileRange tiles_meeting(const PixelRect& part) {
  return tiles_between(static_cast<int>(part.x), static_cast<int>(part.y),
                       static_cast<int>(part.x + part.width),
                       static_cast<int>(part.y + part.height));
}

class Binner {
 public:
  Binner(const Frame& frame, const BoundsOfCell& other_bounds, ImageSize size,
         const PixelRect& part)
      : frame_(frame),
        other_bounds_(other_bounds),
        width_(static_cast<int>(size.width)),
        height_(static_cast<int>(size.height)),
        all_(tiles_meeting(part)) {}

  // The range of all tiles.
  [[nodiscard]] const TileRange& all() const { return all_; }

  [[nodiscard]] TileRange range(CellId cell) const {
    if (other_bounds_)
      if (const auto bounds = other_bounds_(cell)) return tiles_of(*bounds);
    return tiles_of(screen_bounds(frame_, cell));
  }

 private:
  // The tiles that a cell may cover: none if it lies outside the clipping slab; all of them if it
  // reaches beside or behind the eye, because it then has no bounds on the screen.
  [[nodiscard]] TileRange tiles_of(const ScreenBounds& box) const {
    const bool with_doubts = !frame_.skin.sides.empty();
    const double along = with_doubts ? frame_.witness_tolerance : 0;
    const double aside = with_doubts ? kBesideSkin : 0;
    if (box.nearest > frame_.projector.far() + along) return {};
    if (box.farthest < frame_.projector.near() - along) return {};
    if (!box.in_front) return all_;
    const int x0 = first_center(box.x0 - aside, 0, width_);
    const int x1 = first_center(box.x1 + aside, 0, width_);
    const int y0 = first_center(box.y0 - aside, 0, height_);
    const int y1 = first_center(box.y1 + aside, 0, height_);
    if (x0 >= x1 || y0 >= y1) return {};
    const TileRange range = tiles_between(x0, y0, x1, y1);
    return {std::max(range.column0, all_.column0), std::max(range.row0, all_.row0),
            std::min(range.column1, all_.column1), std::min(range.row1, all_.row1)};
  }

  const Frame& frame_;
  const BoundsOfCell& other_bounds_;
  int width_, height_;
  TileRange all_;
};

template <typename Visit>
void for_each_tile(const TileRange& range, const TileRange& all, const Visit& visit) {
  for (int row = range.row0; row < range.row1; ++row)
    for (int column = range.column0; column < range.column1; ++column)
      visit(static_cast<std::size_t>(row - all.row0) *
                static_cast<std::size_t>(all.column1 - all.column0) +
            static_cast<std::size_t>(column - all.column0));
}

// Replaces the number of a chunk's cells in a tile, by chunk and then tile, by the position in the
// tile's run where the chunk begins to write. Returns where the tiles' runs begin, and where the
// last one ends.
std::vector<std::uint64_t> places_of_counts(std::span<std::uint32_t> counts,
                                            std::size_t tile_count) {
  std::vector<std::uint32_t> lengths(tile_count, 0);  // a run holds a cell once
  for (std::size_t chunk = 0; chunk * tile_count < counts.size(); ++chunk)
    for (std::size_t tile = 0; tile < tile_count; ++tile) {
      std::uint32_t& count = counts[chunk * tile_count + tile];
      count = std::exchange(lengths[tile], lengths[tile] + count);
    }
  std::vector<std::uint64_t> start(tile_count + 1, 0);
  std::inclusive_scan(lengths.begin(), lengths.end(), start.begin() + 1, std::plus<>(),
                      std::uint64_t{0});
  return start;
}

}  // namespace

std::vector<TileRect> tiles_of(ImageSize size, const PixelRect& part) {
  const TileRange all = tiles_meeting(part);
  std::vector<TileRect> tiles;
  for (int row = all.row0; row < all.row1; ++row)
    for (int column = all.column0; column < all.column1; ++column)
      tiles.push_back({column * kWidth, row * kHeight,
                       std::min((column + 1) * kWidth, static_cast<int>(size.width)),
                       std::min((row + 1) * kHeight, static_cast<int>(size.height))});
  return tiles;
}

TileBins bin_cells(const Frame& frame, const VisibilityOrder& order, ImageSize size,
                   const PixelRect& part, const BoundsOfCell& other_bounds) {
  const Binner binner(frame, other_bounds, size, part);
  TileBins bins;
  bins.tiles = tiles_of(size, part);
  const std::size_t tile_count = bins.tiles.size(), cells = order.cells.size();
  const std::size_t chunks = (cells + kCellsPerChunk - 1) / kCellsPerChunk;

  // in memory order, which differs from the visibility order
  const std::size_t range_count = frame.mesh.cell_count();
  const auto ranges = unset_array<TileRange>(range_count);
  parallel_for(range_count, kCellsPerChunk, [&](IndexRange range) {
    for (std::size_t cell = range.begin; cell < range.end; ++cell)
      ranges[cell] = binner.range(static_cast<CellId>(cell));
  });
  const auto cell_ids = order.cells.view();
  const auto each_tile = [&](IndexRange range, const auto& visit) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (i + kFetchAhead < range.end) __builtin_prefetch(&ranges[cell_ids[i + kFetchAhead]]);
      for_each_tile(ranges[cell_ids[i]], binner.all(), [&](std::size_t tile) { visit(i, tile); });
    }
  };

  // count by chunk and tile; the counts tell every chunk where in each tile's run to write
  std::vector<std::uint32_t> counts(chunks * tile_count, 0);
  parallel_for(cells, kCellsPerChunk, [&](IndexRange range) {
    std::uint32_t* count = counts.data() + range.begin / kCellsPerChunk * tile_count;
    each_tile(range, [&](std::size_t, std::size_t tile) { ++count[tile]; });
  });
  bins.start = places_of_counts(counts, tile_count);
  bins.ranks = large_vector<std::uint32_t>(bins.start.back());
  parallel_for(cells, kCellsPerChunk, [&](IndexRange range) {
    std::uint32_t* place = counts.data() + range.begin / kCellsPerChunk * tile_count;
    each_tile(range, [&](std::size_t i, std::size_t tile) {
      bins.ranks[bins.start[tile] + place[tile]++] = static_cast<std::uint32_t>(i);
    });
  });
  return bins;
}

}  // namespace hiac
