#pragma once

#include <span>

#include "hiac/frame/frame.hpp"
#include "hiac/render/pixels/tile.hpp"

namespace hiac {

/// Draws cells in a tile, in the order given.
using DrawCells = void (*)(const TileTarget& to, std::span<const CellId> cells);

/// The function that draws a cell: a kernel, or render_general_cells. It does not depend on the
/// requested channels.
DrawCells draw_for(const Frame& frame, CellId cell);

}  // namespace hiac
