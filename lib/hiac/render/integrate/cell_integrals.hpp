#pragma once

#include "hiac/element/cell_polynomials.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/frame/interval_range.hpp"
#include "hiac/render/cells/cell_segments.hpp"

namespace hiac {

/// Integrates segments of a cell of any kind many at a time: fields along rays as in
/// field_along_ray.hpp, radiance as in polynomial_piece.hpp, both without bounds of rounding.
/// Overwrites the padding behind the segments. `color`, `extinction`: the intervals of the transfer
/// functions that the fields reach in the cell. A segment is left undone if Newton's iteration from
/// a nearby start does not find its points in the cell, or if its fields would need too short
/// pieces.
void integrate_cell_segments(const Frame& frame, const CellPolynomials& cell, IntervalRange color,
                             IntervalRange extinction, CellSegments& segments);

}  // namespace hiac
