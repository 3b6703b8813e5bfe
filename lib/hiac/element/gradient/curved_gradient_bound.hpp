#pragma once

#include <array>
#include <span>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// A proven bound, rounding included, of the gradient of the isoparametric interpolant of a field
/// in one cell of any kind and order, with straight or curved edges.
///
/// By Cramer's rule the gradient's components are ratios of Jacobian determinants, in the numerator
/// with the field in place of one coordinate. On the cube that the cell is collapsed from
/// (interpolant_range.hpp) coordinates and fields are polynomials, and so are their determinants:
/// in Bernstein form |grad f| = |sum N_i B_i| / |sum D_i B_i|, which is at most the largest |N_i| /
/// D_i if all D_i have one sign; the collapse's own factor cancels. If not all D_i have one sign,
/// the cube is subdivided. The bound is infinite if the determinant vanishes or nothing could be
/// proven.
///
/// `nodes`: positions of the kind's nodes, in their order; `values`: of the field there.
double curved_gradient_bound(CellKind kind, std::span<const std::array<double, 3>> nodes,
                             std::span<const double> values);

}  // namespace hiac
