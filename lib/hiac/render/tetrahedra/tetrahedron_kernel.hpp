#pragma once

#include <span>

#include "hiac/frame/frame.hpp"
#include "hiac/render/pixels/tile.hpp"

namespace hiac {

/// Renders linear tetrahedra into a tile, in the order given (section 5.1, without slicing: rays
/// are cut at the transfer functions' breakpoints). All their nodes must be projectable.
///
/// Scan conversion is watertight: where a row of pixel centres crosses a projected edge is computed
/// once from the edge's two nodes, the same for all cells around the edge, and a centre that lies
/// on the edge counts as being to its right (on a horizontal edge, below it). Each face is hit by
/// the same pixels from both sides, so no ray slips through between neighbours.
///
/// The machine's best instruction set is chosen at run time.
void render_tetrahedra(const TileTarget& to, std::span<const CellId> cells);

}  // namespace hiac
