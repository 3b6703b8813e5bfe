#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hiac {

/// Extent of a tile. Tiles are small enough for a thread's buffers to stay in its cache.
inline constexpr std::size_t kTileWidth = 64;
inline constexpr std::size_t kTileHeight = 32;

/// Planes of a tile's pixels are rows of kTileStride doubles. The padding after each row lets
/// vectors extend beyond its end.
inline constexpr std::size_t kTileStride = kTileWidth + 8;

/// Entries of a plane, padding included: the index of a pixel is below it.
inline constexpr std::size_t kTilePlane = kTileStride * kTileHeight;

/// The coordinate of the centre of a column or row of pixels (ProjectedNode), a whole number.
constexpr double pixel_center(double pixel) { return pixel + 0.5; }

/// The first pixel from `low` on whose centre lies at or after a coordinate, or before it by no
/// more than `slack`; `high` where that is farther.
inline int first_center(double coordinate, int low, int high, double slack = 0) {
  return static_cast<int>(std::ceil(
      std::clamp(coordinate - (0.5 + slack), static_cast<double>(low), static_cast<double>(high))));
}

/// The pixels of one tile: columns [x0, x1), rows [y0, y1) of the image.
struct TileRect {
  int x0, y0, x1, y1;

  /// The index of pixel (x, y) into the tile's planes; column() and row() are its inverse.
  [[nodiscard]] constexpr std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - y0) * kTileStride + static_cast<std::size_t>(x - x0);
  }
  [[nodiscard]] constexpr int column(std::size_t at) const {
    return x0 + static_cast<int>(at % kTileStride);
  }
  [[nodiscard]] constexpr int row(std::size_t at) const {
    return y0 + static_cast<int>(at / kTileStride);
  }
};

/// Light and transparency of a tile's pixels, accumulated front to back.
struct TilePixels {
  // consecutive in memory, so that a kernel needs one address for all of them
  using Plane = std::array<double, kTilePlane>;
  alignas(64) Plane red, green, blue;  ///< premultiplied, without background
  Plane transparency;                  ///< of all that lies in front so far
  Plane last;  ///< ray parameter at which the last segment ended; -infinity if none
};

/// Events counted while a tile is drawn.
struct TileCounts {
  std::uint64_t segments = 0;    ///< ray segments met (a cell and a pixel each)
  std::uint64_t violations = 0;  ///< segments that began before the last one had ended (section 4)

  TileCounts& operator+=(const TileCounts& other) {
    segments += other.segments;
    violations += other.violations;
    return *this;
  }
};

}  // namespace hiac
