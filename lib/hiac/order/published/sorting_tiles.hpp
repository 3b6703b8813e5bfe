#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hiac/order/published/multitiled.hpp"
#include "hiac/order/published/screen_extents.hpp"

namespace hiac {

/// The Tile Sorting Lists of the multitiled sort (Williams, Max, Stein 1998, section 6.2): for each
/// tile of each window, the cells whose extents overlap it, by ascending rank.
///
/// A place is an index into the arrays; tile t has the places start[t] ... start[t + 1] - 1.
struct SortingTiles {
  std::vector<std::size_t> start;
  std::vector<std::uint32_t> ranks;
  std::vector<float> x_low, x_high, y_low, y_high;
  struct Diagonal {
    float sum_low, sum_high, difference_low, difference_high;
  };
  std::vector<Diagonal> diagonals;  ///< bounds of x + y and x - y
  /// Whether the extent begins in a tile further left (bit 0), or further down (bit 1). Two cells
  /// that overlap have exactly one common tile in which not both begin further left and not both
  /// begin further down.
  std::vector<std::uint8_t> begins_before;
  /// The places of the cell of rank r: places_of[first_place[r]] ... [first_place[r + 1] - 1].
  std::vector<std::size_t> first_place;
  std::vector<std::size_t> places_of;

  [[nodiscard]] std::size_t tile_count() const { return start.size() - 1; }
  [[nodiscard]] std::span<const std::size_t> places(std::uint32_t rank) const {
    return std::span(places_of).subspan(first_place[rank],
                                        first_place[rank + 1] - first_place[rank]);
  }
  [[nodiscard]] bool diagonals_meet(std::size_t a, std::size_t b) const {
    const Diagonal &p = diagonals[a], &q = diagonals[b];
    return p.sum_low <= q.sum_high && q.sum_low <= p.sum_high &&
           p.difference_low <= q.difference_high && q.difference_low <= p.difference_high;
  }
  /// Returns whether this tile is the one that pairs the cells of two of its places.
  [[nodiscard]] bool pairs_here(std::size_t a, std::size_t b) const {
    return (begins_before[a] & begins_before[b]) == 0;
  }
};

SortingTiles sorting_tiles(const std::vector<WindowCells>& windows, std::size_t cell_count,
                           const TilingOptions& tiling);

}  // namespace hiac
