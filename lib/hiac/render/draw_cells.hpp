#pragma once

#include <span>

#include "hiac/frame/frame.hpp"
#include "hiac/render/pixels/tile.hpp"

namespace hiac {

/// Draws cells into a tile, or into a group's list where there is one.
using DrawCells = void (*)(const Frame& frame, std::span<const CellId> cells, const TileRect& tile,
                           TileBuffer& buffer, SegmentList* group, TileCounts& counts);

/// What draws a cell: a kernel, or render_general_cells. It does not depend on the channels that
/// are asked for.
DrawCells draw_for(const Frame& frame, CellId cell);

}  // namespace hiac
