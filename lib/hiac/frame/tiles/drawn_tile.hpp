#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>

#include "hiac/frame/tiles/tile.hpp"

namespace hiac {

/// Facts about a pixel besides its light. Depths are ray parameters.
struct PixelFacts {
  /// The start of the first segment that emits or absorbs, or the first isosurface.
  double first = std::numeric_limits<double>::infinity();
  double weight = 0, weighted_depth = 0;  ///< sums of opacities, and of these times their depths
  std::uint32_t cells = 0, violations = 0;
};

/// A tile as drawn by an engine: the source of pictures and their channels.
class DrawnTile {
 public:
  DrawnTile() = default;
  DrawnTile(const DrawnTile&) = delete;
  DrawnTile& operator=(const DrawnTile&) = delete;
  virtual ~DrawnTile() = default;

  [[nodiscard]] virtual const TilePixels& pixels() const = 0;
  [[nodiscard]] virtual const TileCounts& counts() const = 0;
  /// The facts of a pixel, given by its index in the planes. Needs Frame::with_details.
  [[nodiscard]] virtual const PixelFacts& facts(std::size_t at) const = 0;
  /// The bound of a pixel's error over a background whose largest channel is `background`; NaN if
  /// unknown. Needs Frame::with_error.
  [[nodiscard]] virtual double error(std::size_t at, double background) = 0;
  /// The transparency of the skin and the edges alone in a pixel: the pixel's transparency divided
  /// by it is that of the medium and the isosurfaces. 1 of an engine that draws neither.
  [[nodiscard]] virtual double surface_transparency(std::size_t /*at*/) const { return 1; }
};

/// An engine: draws the cells at given positions of the visibility order (TileBins), front to back,
/// in one tile, and passes the tile to `take`. Called by several threads at a time.
using TakeTile = std::function<void(DrawnTile&)>;
using DrawTile = std::function<void(const TileRect& tile, std::span<const std::uint32_t> ranks,
                                    const TakeTile& take)>;

}  // namespace hiac
