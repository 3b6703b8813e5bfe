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

/// Computes tighter error bounds of a tile's pixels where those of pixel_error are large.
///
/// Bounds add up the largest effect of every rounding; the actual error is far smaller. A pixel
/// whose bound exceeds a tenth of the tolerance is recomputed with 64-bit mantissas, which are 2048
/// times as fine, by the same method and therefore with the same bound in their unit (Arithmetic).
/// The difference of the two results plus that bound is a bound of the error. The picture does not
/// change.
///
/// Only rays that meet linear cells with planar faces, each at most once, are recomputed
/// (ExtendedSegments, ExtendedCellSegments), and no edges; other pixels keep their bound.
class PixelRefinement {
 public:
  /// `ranks`: positions in the visibility order of the cells that the tile may show. The arguments
  /// must outlive this object. Needs Frame::with_error.
  PixelRefinement(const Frame& frame, const VisibilityOrder& order, const TileRect& tile,
                  std::span<const std::uint32_t> ranks);

  /// The error bound of the pixel with index `at` in the planes of the finished tile, over a
  /// background whose largest channel is `background`.
  double error(const TileBuffer& drawn, std::size_t at, double background);

 private:
  // The pixels whose rays may meet a cell.
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
  ExtendedSegments segments_;           // for tetrahedra
  ExtendedCellSegments cell_segments_;  // for other cells
  std::vector<Box> boxes_;              // of `ranks`; empty until the first pixel is recomputed
};

}  // namespace hiac
