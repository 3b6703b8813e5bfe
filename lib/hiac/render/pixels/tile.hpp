#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hiac/frame/projection.hpp"
#include "hiac/render/pixels/pixel_details.hpp"

namespace hiac {

/// Extent of a tile. Tiles are small enough for a thread's buffers to stay in its cache.
inline constexpr std::size_t kTileWidth = 64;
inline constexpr std::size_t kTileHeight = 32;

/// The pixels of one tile: columns [x0, x1), rows [y0, y1) of the image.
struct TileRect {
  int x0, y0, x1, y1;
};

/// Accumulated radiance of a tile's pixels, front to back. Planes of rows of kTileStride doubles;
/// pixel (x, y) is at (y - y0) * kTileStride + (x - x0). The slack after each row lets vectors
/// overhang its end.
inline constexpr std::size_t kTileStride = kTileWidth + 8;

struct TileBuffer {
  // one after another in memory, so that a kernel needs one address for all of them
  using Plane = std::array<double, kTileStride * kTileHeight>;
  alignas(64) Plane red, green, blue;  ///< premultiplied, without background
  Plane transparency;                  ///< of all that lies in front so far
  Plane last;                          ///< ray parameter at which the last segment ended
  Plane ray_scale;                     ///< world length per unit of ray parameter
  std::vector<PixelDetails> details;   ///< empty where no channel needs them

  /// Empties the buffer for a tile.
  void reset(const TileRect& tile, const Projector& projector, bool with_details);

  /// Tells a pixel's details of a segment that is about to be composited.
  void describe(std::size_t at, const SegmentDetails& segment);
};

/// Ray segments whose order is yet to be found: those of a group of cells in one tile. Arrays of
/// equal length.
struct SegmentList {
  std::vector<std::uint32_t> pixel;  ///< index into the tile's planes
  std::vector<double> front, back;   ///< ray parameters
  std::vector<double> red, green, blue, transparency;
  std::vector<SegmentDetails> details;  ///< empty where no channel needs them

  [[nodiscard]] std::size_t size() const { return pixel.size(); }
  void clear();
  void append(std::uint32_t at, double t_front, double t_back, double r, double g, double b,
              double zeta);
  /// The order of one pixel's segments: by depth.
  [[nodiscard]] bool nearer(std::uint32_t a, std::uint32_t b) const;
};

/// Events counted while rendering.
struct TileCounts {
  std::uint64_t segments = 0;    ///< ray segments met (a cell and a pixel each)
  std::uint64_t violations = 0;  ///< segments that began before the last one had ended (section 4)

  TileCounts& operator+=(const TileCounts& other) {
    segments += other.segments;
    violations += other.violations;
    return *this;
  }
};

/// Sorts the segments by pixel and depth and composites them: exact whatever order they came in.
void composite_sorted(const SegmentList& segments, double witness_tolerance, TileBuffer& buffer,
                      TileCounts& counts);

}  // namespace hiac
