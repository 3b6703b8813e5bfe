#include "hiac/order/published/sorting_tiles.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace hiac {
namespace {

// Returns n^(1/6), rounded.
std::size_t default_tiles(std::size_t cells) {
  return std::max<std::size_t>(
      1, static_cast<std::size_t>(std::lround(std::pow(static_cast<double>(cells), 1.0 / 6))));
}

// Returns the inner boundaries between `count` equal parts of [-1, 1], ascending.
std::vector<float> equal_parts(std::size_t count) {
  std::vector<float> boundaries;
  for (std::size_t i = 1; i < count; ++i)
    boundaries.push_back(-1 + 2 * static_cast<float>(i) / static_cast<float>(count));
  return boundaries;
}

// Returns boundaries with equally many of the values between them. Shuffles the values.
std::vector<float> balanced_parts(std::size_t count, std::vector<float>& values) {
  std::vector<float> boundaries;
  std::ranges::sort(values);
  for (std::size_t i = 1; i < count && !values.empty(); ++i)
    boundaries.push_back(values[values.size() * i / count]);
  return boundaries;
}

std::size_t part_of(float x, const std::vector<float>& boundaries) {
  return static_cast<std::size_t>(std::ranges::upper_bound(boundaries, x) - boundaries.begin());
}

// Columns, each with its own rows.
class Grid {
 public:
  Grid(const WindowCells& cells, std::size_t columns, std::size_t rows, bool balanced)
      : rows_(rows) {
    if (!balanced) {
      columns_ = equal_parts(columns);
      row_boundaries_.assign(columns, equal_parts(rows));
      return;
    }
    std::vector<float> middles;
    for (const ScreenExtent& e : cells.extents) middles.push_back((e.x_low + e.x_high) / 2);
    columns_ = balanced_parts(columns, middles);
    std::vector<std::vector<float>> by_column(columns);
    for (const ScreenExtent& e : cells.extents)
      by_column[part_of((e.x_low + e.x_high) / 2, columns_)].push_back((e.y_low + e.y_high) / 2);
    for (auto& column : by_column) row_boundaries_.push_back(balanced_parts(rows, column));
  }

  [[nodiscard]] std::size_t tile_count() const { return row_boundaries_.size() * rows_; }

  // Calls visit(tile, begins_before) for every tile that the extent overlaps.
  template <typename Visit>
  void for_each_tile(const ScreenExtent& e, const Visit& visit) const {
    const std::size_t left = part_of(e.x_low, columns_), right = part_of(e.x_high, columns_);
    for (std::size_t column = left; column <= right; ++column) {
      const auto& rows = row_boundaries_[column];
      const std::size_t bottom = part_of(e.y_low, rows), top = part_of(e.y_high, rows);
      for (std::size_t row = bottom; row <= top; ++row)
        visit(column * rows_ + row,
              static_cast<std::uint8_t>((column > left ? 1U : 0U) | (row > bottom ? 2U : 0U)));
    }
  }

 private:
  std::size_t rows_;
  std::vector<float> columns_;
  std::vector<std::vector<float>> row_boundaries_;  // by column
};

// Appends the tiles of one window.
void add_window(const WindowCells& cells, const Grid& grid, SortingTiles& tiles) {
  std::vector<std::size_t> next(grid.tile_count() + 1, 0);
  for (const ScreenExtent& e : cells.extents)
    grid.for_each_tile(e, [&](std::size_t tile, std::uint8_t) { ++next[tile + 1]; });
  next[0] = tiles.start.back();
  for (std::size_t tile = 0; tile < grid.tile_count(); ++tile) {
    next[tile + 1] += next[tile];
    tiles.start.push_back(next[tile + 1]);
  }
  const std::size_t places = tiles.start.back();
  tiles.ranks.resize(places);
  tiles.begins_before.resize(places);
  tiles.diagonals.resize(places);
  for (auto* bound : {&tiles.x_low, &tiles.x_high, &tiles.y_low, &tiles.y_high})
    bound->resize(places);
  for (std::size_t i = 0; i < cells.ranks.size(); ++i) {
    const ScreenExtent& e = cells.extents[i];
    grid.for_each_tile(e, [&](std::size_t tile, std::uint8_t begins_before) {
      const std::size_t place = next[tile]++;
      tiles.ranks[place] = cells.ranks[i];
      tiles.begins_before[place] = begins_before;
      tiles.x_low[place] = e.x_low, tiles.x_high[place] = e.x_high;
      tiles.y_low[place] = e.y_low, tiles.y_high[place] = e.y_high;
      tiles.diagonals[place] = {e.sum_low, e.sum_high, e.difference_low, e.difference_high};
    });
  }
}

void find_places(std::size_t cell_count, SortingTiles& tiles) {
  tiles.first_place.assign(cell_count + 1, 0);
  for (const std::uint32_t rank : tiles.ranks) ++tiles.first_place[rank + 1];
  for (std::size_t rank = 0; rank < cell_count; ++rank)
    tiles.first_place[rank + 1] += tiles.first_place[rank];
  std::vector<std::size_t> next(tiles.first_place.begin(), tiles.first_place.end() - 1);
  tiles.places_of.resize(tiles.ranks.size());
  for (std::size_t place = 0; place < tiles.ranks.size(); ++place)
    tiles.places_of[next[tiles.ranks[place]]++] = place;
}

}  // namespace

SortingTiles sorting_tiles(const std::vector<WindowCells>& windows, std::size_t cell_count,
                           const TilingOptions& tiling) {
  const std::size_t by_default = default_tiles(cell_count);
  const std::size_t columns = tiling.columns == 0 ? by_default : tiling.columns;
  const std::size_t rows = tiling.rows == 0 ? by_default : tiling.rows;
  SortingTiles tiles;
  tiles.start.push_back(0);
  for (const WindowCells& cells : windows)
    add_window(cells, Grid(cells, columns, rows, tiling.balanced), tiles);
  find_places(cell_count, tiles);
  return tiles;
}

}  // namespace hiac
