#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hiac/frame/tiles/tile.hpp"

namespace hiac {

/// A set of a tile's pixels, by their indices into the tile's planes; initially empty.
class PixelMask {
 public:
  void add(std::size_t at) { rows_[at / kTileStride] |= bit(at); }
  void remove(std::size_t at) { rows_[at / kTileStride] &= ~bit(at); }
  [[nodiscard]] bool holds(std::size_t at) const {
    return (rows_[at / kTileStride] & bit(at)) != 0;
  }
  /// Of a pixel in a column and row, both counted from the tile's first.
  [[nodiscard]] bool holds(int x, int y) const { return (row(y) >> x & 1U) != 0; }
  [[nodiscard]] bool any() const { return rows_ != decltype(rows_){}; }
  /// The pixels of a row, both counted from the tile's first: the first pixel in the lowest bit.
  [[nodiscard]] std::uint64_t row(int y) const { return rows_[static_cast<std::size_t>(y)]; }
  [[nodiscard]] std::span<const std::uint64_t, kTileHeight> rows() const { return rows_; }
  /// Adds all of another set, given by its rows().
  void add_rows(std::span<const std::uint64_t> rows) {
    for (std::size_t k = 0; k < kTileHeight; ++k) rows_[k] |= rows[k];
  }

 private:
  static_assert(kTileWidth <= 64);
  static std::uint64_t bit(std::size_t at) { return std::uint64_t{1} << (at % kTileStride); }

  std::array<std::uint64_t, kTileHeight> rows_{};
};

}  // namespace hiac
