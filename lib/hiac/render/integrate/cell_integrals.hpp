#pragma once

#include "hiac/element/cell_polynomials.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/frame/interval_range.hpp"
#include "hiac/render/cells/cell_segments.hpp"

namespace hiac {

/// Integrates segments, behind which it writes kPadding without meaning, of a cell of any kind
/// many at a time: fields along rays as in field_along_ray.hpp, radiance as in
/// polynomial_piece.hpp, both without bounds of rounding. `color`, `extinction`: the intervals of
/// the transfer functions in which the fields are in the cell. Segments whose places in the cell
/// Newton's iteration does not find from nearby, or whose fields too short pieces would have to be
/// interpolated on, are not done.
void integrate_cell_segments(const Frame& frame, const CellPolynomials& cell, IntervalRange color,
                             IntervalRange extinction, CellSegments& segments);

}  // namespace hiac
