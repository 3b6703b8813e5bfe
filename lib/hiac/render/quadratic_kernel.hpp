#pragma once

#include <span>

#include "hiac/render/frame.hpp"
#include "hiac/render/tile.hpp"

namespace hiac {

/// Whether a cell that kernel_cells() has for it is drawn by render_quadratic_tetrahedra: no
/// isosurface crosses it, no details of pixels are asked for, and integration is exact.
bool for_quadratic_kernel(const Frame& frame, CellId cell);

/// Renders quadratic tetrahedra with straight edges many pixels at a time: the scan conversion of
/// linear tetrahedra (scan_conversion-inl.hpp), which are the same cells to their neighbours, and
/// between entry and exit the field as what it is, a quadratic. Its three coefficients on a segment
/// are the values of the cell's polar form: with barycentric coordinates p where the ray enters, q
/// where it leaves, and the cell's Bernstein coefficients b, sum b_ij p_i p_j, sum b_ij p_i q_j and
/// sum b_ij q_i q_j (section 5.2).
void render_quadratic_tetrahedra(const Frame& frame, std::span<const CellId> cells,
                                 const TileRect& tile, TileBuffer& buffer, SegmentList* group,
                                 TileCounts& counts);

}  // namespace hiac
