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

/// The cells that each tile must draw, front to back.
struct TileBins {
  std::vector<TileRect> tiles;       ///< whole tiles, row by row
  std::vector<std::uint64_t> start;  ///< of each tile's run in `ranks`; one more entry than tiles
  std::vector<std::uint32_t> ranks;  ///< positions in VisibilityOrder::cells, ascending in a tile

  [[nodiscard]] std::span<const std::uint32_t> cells_of(std::size_t tile) const {
    return std::span(ranks).subspan(start[tile], start[tile + 1] - start[tile]);
  }
};

/// The tiles of the picture that meet a part of it, row by row.
std::vector<TileRect> tiles_of(ImageSize size, const PixelRect& part);

/// The bounds of a cell that an engine draws in another form, for example as a splat; none for
/// other cells.
using BoundsOfCell = std::function<std::optional<ScreenBounds>(CellId)>;

/// Assigns the cells to those tiles of a part of the picture that their projections, or their
/// `other_bounds`, may cover; cells whose bounding box contains no pixel centre, or that lie
/// outside the clipping slab, are not assigned. The tiles are those of the whole picture. Takes
/// linear time, in parallel; the result does not depend on the number of threads.
TileBins bin_cells(const Frame& frame, const VisibilityOrder& order, ImageSize size,
                   const PixelRect& part, const BoundsOfCell& other_bounds = {});

}  // namespace hiac
