#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/frame/tiles/tile_bins.hpp"
#include "hiac/render/pixels/tile.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// Subpixel splatting (Williams, Max, Stein 1998, section 5.3): a cell whose projection covers too
/// few pixel centres for rays to sample it with the correct weight is treated as if it were
/// concentrated at its centre of gravity. Its optical depth there, a delta function, is convolved
/// with the biquadratic B-spline, so that it is spread over 3 x 3 pixels.
///
/// With V the volume and tau the extinction at the centre of gravity (fields there by their
/// interpolants), the optical depth of the cell, integrated over the screen in pixels, is tau V
/// times the area in pixels that a unit of area across the ray has there. A pixel gets of it what
/// the kernel has at its centre, and composites it like a uniform segment of a ray: transparencies
/// multiply, so the optical depths of splats add up and a pixel's opacity is that of all of them
/// whatever their number. The light is that of such a segment with the colour at the centre of
/// gravity, for either glow.
///
/// The kernel reaches pixels that the cell does not cover, and of cells that do not cover each
/// other a visibility order may have any first. In a pixel, splats are therefore sorted by the
/// depth of their centres of gravity, among themselves and among the ray segments that begin before
/// and behind them. In a tile with splats, segments are sorted by depth too, 256 cells at a time;
/// there the witness detects errors of the order between these batches.
///
/// Where the optical depth of a pixel is small, the picture is the exact one convolved with the
/// kernel. Where it is large, optical depth is blurred rather than light; and as section 5.3 says,
/// of two cells smaller than a pixel, one before the other, neither hides the other entirely.
///
/// A cell is splatted when fewer than scene.render.splat_below pixel centres lie in its projection,
/// whether or not they are pixels of the picture, counted as the engine finds them. A cell smaller
/// than a pixel covers one centre or none: below 2, as the paper has it, is the least that makes
/// such cells splats wherever they lie (below 1, those that happen to meet a ray would weigh a
/// whole pixel and the others be added to them). Not splatted, but met by rays as any other, are
/// cells that isosurfaces cross, that reach out of the clipping slab, or beside the eye.

/// Which cells of a frame are splatted and may be seen in the picture.
class SplattedCells {
 public:
  /// `splat_below`: scene.render.splat_below; 0: none.
  SplattedCells(const Frame& frame, ImageSize size, std::uint32_t splat_below);

  [[nodiscard]] bool none() const { return is_splatted_.empty(); }
  [[nodiscard]] bool holds(CellId cell) const { return !none() && is_splatted_[cell] != 0; }
  [[nodiscard]] std::uint64_t count() const;

 private:
  std::vector<std::uint8_t> is_splatted_;  // a flag a cell; empty where none is
};

/// A cell's centre of gravity, and the data of its splat except optics.
struct Splat {
  double x, y;    ///< pixel coordinates
  double t;       ///< ray parameter
  double length;  ///< of the rays through the cell, world units, integrated over the screen, pixels
  std::array<double, 3> point;  ///< in the world
};
Splat splat_of(const Frame& frame, CellId cell);

/// Where the kernels of splats reach, for the tiles' bins. The arguments must outlive it.
BoundsOfCell splat_bounds(const Frame& frame, const SplattedCells& splatted);

/// The splats of one tile, on their way into its pixels: front to back, after the ray segments that
/// begin before them.
class TileSplats {
 public:
  /// Of the cells at these places of an order, those that are splatted.
  TileSplats(const Frame& frame, const SplattedCells& splatted, std::span<const CellId> order,
             std::span<const std::uint32_t> ranks, const TileRect& tile);

  [[nodiscard]] bool empty() const { return splats_.empty(); }

  /// Appends the pixels' shares of splats that are not yet there and lie before some segment of
  /// theirs in the list.
  void append_before(const TileBuffer& buffer, SegmentList& list);
  /// Appends all that are left.
  void append_rest(const TileBuffer& buffer, SegmentList& list);

 private:
  struct Glowing {
    double x, y, t, length, extinction;
    Color color;
    CellId cell;
  };
  void add(CellId cell);
  void deal_out();
  template <typename Visit>
  void for_each_pixel(const Glowing& splat, const Visit& visit) const;
  void append(std::size_t at, double before, const TileBuffer& buffer, SegmentList& list);

  const Frame& frame_;
  TileRect tile_;
  std::vector<Glowing> splats_;          // by depth
  std::vector<std::uint32_t> of_pixel_;  // the pixels' splats, by depth
  std::vector<std::size_t> next_, end_;  // of each pixel's, those that are left
};

}  // namespace hiac
