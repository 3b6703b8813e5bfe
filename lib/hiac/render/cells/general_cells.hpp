#pragma once

#include <span>

#include "hiac/frame/frame.hpp"
#include "hiac/render/pixels/tile.hpp"

namespace hiac {

/// Renders the cells that the tetrahedron kernel does not: cells of any kind, also beside and
/// behind the eye. Order, watertight scan conversion and compositing are those of the kernel; the
/// field along a ray is the isoparametric interpolant.
void render_general_cells(const TileTarget& to, std::span<const CellId> cells);

}  // namespace hiac
