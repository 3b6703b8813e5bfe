#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/render/pixels/pixel_details.hpp"
#include "hiac/render/pixels/tile.hpp"
#include "hiac/render/refine/extended_cell_segment.hpp"
#include "hiac/render/refine/extended_segment.hpp"

namespace hiac {

/// Better bounds of the errors of a tile's pixels, where those of pixel_error are large.
///
/// Bounds add up the worst that every rounding might do; what it has done is far less. A pixel
/// whose bound is more than a tenth of the tolerance is computed again with numbers of 64-bit
/// mantissas, which are 2048 times as fine, by the same method and so to the same bound in their
/// unit (Arithmetic): what differs between the two and that bound together bound the error. The
/// picture stays as it is.
///
/// This is done of rays that meet linear cells with planar faces alone, each at most once
/// (ExtendedSegments, ExtendedCellSegments); other pixels keep their bound.
class PixelRefinement {
 public:
  /// `ranks`: positions in the order of the cells that the tile may meet. The arguments must
  /// outlive it. Needs Frame::with_error.
  PixelRefinement(const Frame& frame, const VisibilityOrder& order, const TileRect& tile,
                  std::span<const std::uint32_t> ranks);

  /// The bound of the error of a pixel of the finished tile, `at` in its planes, with something
  /// behind it whose largest channel is `background`.
  double error(const TileBuffer& drawn, std::size_t at, double background);

 private:
  // Pixels whose rays a cell may meet.
  struct Box {
    double x0, y0, x1, y1;
  };
  struct Again {
    ExtendedLight light;
    PixelDetails details;
    bool ended = false;
  };
  using Met = ExtendedSegments::Met;

  void set_boxes();
  [[nodiscard]] bool may_meet(std::size_t i, int x, int y) const;
  Met find(CellId cell, int x, int y, ExtendedSegment& segment);
  std::optional<Again> compute_again(int x, int y);
  void composite(const ExtendedSegment& segment, Again& pixel) const;

  const Frame& frame_;
  const VisibilityOrder& order_;
  TileRect tile_;
  std::span<const std::uint32_t> ranks_;
  ExtendedSegments segments_;           // of tetrahedra
  ExtendedCellSegments cell_segments_;  // of other cells
  std::vector<Box> boxes_;              // of `ranks`; empty until the first pixel is computed again
};

}  // namespace hiac
