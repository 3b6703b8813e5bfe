#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/order/gaps/gap_window.hpp"

namespace hiac {

/// The part of a window that faces cover, and the sums of their widths and heights.
struct FaceExtent {
  Interval x, y;
  double sum_of_widths = 0, sum_of_heights = 0;
  std::size_t faces = 0;

  void include(const Outline& outline);
};

/// A rectangle in units of 2^-15 of a grid, rounded outwards.
struct GridBounds {
  std::uint16_t x_low, y_low, x_high, y_high;
};

/// A face as it is binned into a grid.
struct BinnedFace {
  GridBounds bounds;
  float depth;         ///< one end of its depth range, rounded
  std::uint32_t face;  ///< its number
};

/// Faces by tile: tile t has members[start[t]] ... members[start[t + 1] - 1].
struct FaceBins {
  std::vector<std::uint64_t> start;
  std::vector<BinnedFace> members;

  [[nodiscard]] std::span<const BinnedFace> operator[](std::size_t tile) const {
    return std::span(members).subspan(start[tile], start[tile + 1] - start[tile]);
  }
};

/// A regular grid over the part of a window that faces cover.
class FaceGrid {
 public:
  /// Makes tiles about as large as the mean face, but not many more tiles than faces.
  explicit FaceGrid(const FaceExtent& extent);

  [[nodiscard]] std::size_t tiles() const { return std::size_t{x_.tiles} * y_.tiles; }
  [[nodiscard]] std::size_t tile_at(std::uint16_t x, std::uint16_t y) const {
    return y_.tile(y) * x_.tiles + x_.tile(x);
  }

  /// Returns a face in the form in which it is binned; `depth` is rounded upwards or downwards.
  [[nodiscard]] BinnedFace binned(const Outline& outline, double depth, bool upwards,
                                  std::uint32_t face) const;
  /// Puts every face into each tile that its bounds meet; each tile keeps the faces' order.
  [[nodiscard]] FaceBins bin(std::span<const BinnedFace> faces) const;

 private:
  struct Axis {
    double low = 0, scale = 0;  // a coordinate v is at step (v - low) scale
    std::uint16_t tiles = 1;

    Axis(const Interval& range, double sum_of_sizes, std::size_t faces);
    [[nodiscard]] std::uint16_t step_below(double v) const;
    [[nodiscard]] std::uint16_t step_above(double v) const;
    [[nodiscard]] std::size_t tile(std::uint16_t step) const {
      return (std::size_t{step} * tiles) >> 15U;
    }
  };
  template <typename Visit>
  void for_each_place(std::span<const BinnedFace> faces, const Visit& visit) const;

  Axis x_, y_;
};

/// Decides whether rectangles meet, in three instructions per pair: four comparisons in the four
/// 16-bit lanes of a word, whose results are the lanes' top bits.
class MeetingTest {
 public:
  explicit MeetingTest(const GridBounds& a)
      : lows_(lanes(a.x_low, a.y_low, kLast - a.x_high, kLast - a.y_high)) {}

  /// Returns the other rectangle in the form that meets() takes.
  static std::uint64_t prepared(const GridBounds& b) {
    return kTopBits | lanes(b.x_high, b.y_high, kLast - b.x_low, kLast - b.y_low);
  }
  [[nodiscard]] bool meets(std::uint64_t prepared) const {
    return ((prepared - lows_) & kTopBits) == kTopBits;
  }

 private:
  static constexpr std::uint64_t kTopBits = 0x8000800080008000;
  static constexpr unsigned kLast = 0x7fff;

  static std::uint64_t lanes(unsigned a, unsigned b, unsigned c, unsigned d) {
    return std::uint64_t{a} | std::uint64_t{b} << 16U | std::uint64_t{c} << 32U |
           std::uint64_t{d} << 48U;
  }

  std::uint64_t lows_;
};

}  // namespace hiac
