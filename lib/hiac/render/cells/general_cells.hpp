#pragma once

#include <span>

#include "hiac/frame/frame.hpp"
#include "hiac/render/pixels/tile.hpp"

namespace hiac {

/// Renders what the tetrahedron kernel does not: cells of all kinds with straight edges and planar
/// faces, also beside and behind the eye. Same order, same watertight scan conversion, same
/// compositing; the field along a ray is the isoparametric interpolant.
void render_general_cells(const TileTarget& to, std::span<const CellId> cells);

}  // namespace hiac
