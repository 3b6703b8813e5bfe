#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "hiac/frame/crop.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/frame/tiles/screen_bounds.hpp"
#include "hiac/frame/tiles/tile.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// Which cells each tile must draw, front to back.
struct TileBins {
  std::vector<TileRect> tiles;       ///< whole ones, row by row
  std::vector<std::uint64_t> start;  ///< of each tile's run in `ranks`; one more than tiles
  std::vector<std::uint32_t> ranks;  ///< positions in VisibilityOrder::cells, ascending in a tile

  [[nodiscard]] std::span<const std::uint32_t> cells_of(std::size_t tile) const {
    return std::span(ranks).subspan(start[tile], start[tile + 1] - start[tile]);
  }
};

/// The bounds of a cell that an engine draws as something else, as splats are; none of the others.
using BoundsOfCell = std::function<std::optional<ScreenBounds>(CellId)>;

/// Deals the cells out to the tiles that meet a part of the picture and that their projections, or
/// their `other_bounds`, may cover; cells whose bounding box holds no pixel centre, or that lie
/// outside the clipping slab, go to none. The tiles are those that the whole picture has. Linear,
/// in parallel; the result does not depend on the number of threads.
TileBins bin_cells(const Frame& frame, const VisibilityOrder& order, ImageSize size,
                   const PixelRect& part, const BoundsOfCell& other_bounds = {});

}  // namespace hiac
