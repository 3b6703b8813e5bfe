#pragma once

#include <span>

#include "hiac/frame/frame.hpp"
#include "hiac/render/pixels/tile.hpp"

namespace hiac {

/// Whether a cell that kernel_cells() assigns to one of the kernels below is drawn by it: this
/// needs exact integration, and no isosurface may cross the cell.
bool for_higher_order_kernel(const Frame& frame, CellId cell);

/// Render quadratic and cubic tetrahedra with straight edges many pixels at a time: the scan
/// conversion is that of linear tetrahedra (scan_conversion-inl.hpp), so that neighbours fit;
/// between entry and exit the field is a polynomial of the cell's order. The polynomial's three or
/// four Bernstein coefficients on a segment are values of the cell's polar form
/// (polar_form-inl.hpp; for quadratic cells in section 5.2).
void render_quadratic_tetrahedra(const TileTarget& to, std::span<const CellId> cells);
void render_cubic_tetrahedra(const TileTarget& to, std::span<const CellId> cells);

}  // namespace hiac
