#pragma once

#include <cstdint>
#include <span>

#include "hiac/frame/frame.hpp"
#include "hiac/frame/tiles/pixel_mask.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/render/runs/ray_runs.hpp"
#include "hiac/render/splatting.hpp"

namespace hiac {

/// What a part needs where edges are drawn.
struct EdgesOfPart {
  const PixelMask* mask = nullptr;  ///< of the tile; null: there are none in it
  bool on_all_cells = false;        ///< edges may lie on all cells, otherwise on the boundary's
  std::span<const std::uint8_t> boundary;  ///< of the whole mesh (whole_boundary)
  std::span<const std::uint64_t> global_nodes;

  /// Whether edges may lie on a cell.
  [[nodiscard]] bool may_touch(CellId cell) const {
    return mask != nullptr && (on_all_cells || boundary[cell] != 0);
  }
};

/// Draws a part of a mesh in one tile: the cells at these positions of the part's own order, as
/// AccurateTile does, into runs. A ray ends where the part alone makes it opaque (Frame::
/// least_transparency): then nothing behind is seen in the whole mesh either. The fragments of
/// edges are not among what is drawn.
TileRuns draw_runs(const Frame& frame, const SplattedCells& splatted, const EdgesOfPart& edges,
                   const VisibilityOrder& order, const TileRect& tile,
                   std::span<const std::uint32_t> ranks);

}  // namespace hiac
