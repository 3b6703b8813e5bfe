#pragma once

#include <array>
#include <span>

#include "hiac/element/cell_field.hpp"

namespace hiac {

/// How steep the isoparametric interpolants of fields can be in one cell: a proof, not an estimate.
/// In cells of higher order that of curved_gradient_bound.hpp; in linear ones:
///
/// The gradient is J^-T g, with J the Jacobian of the cell's map and g the field's derivatives in
/// reference coordinates. In the parameters u, v, w of a cube whose images the cells are (a
/// triangle as the collapsed square; a pyramid's and a wedge's collapsing column and derivative
/// divided by what both vanish with) the columns of J and g are combinations, with weights that are
/// not negative and sum to at most one, of their values at the cube's corners: differences of
/// neighbouring corners of the cell. So g and the rows' numerators are no larger than the largest
/// of these and of their cross products; and det J is no smaller than the least of its Bernstein
/// coefficients on the cube. Where these do not all have one sign, nothing is shown, and the bound
/// is infinite. Rounding is on the safe side.
class GradientBound {
 public:
  /// `nodes`: positions of the kind's nodes, in their order; edges whose edge_deviation is not
  /// above `straightness` are taken as straight, as CellMap does.
  GradientBound(CellKind kind, std::span<const std::array<double, 3>> nodes,
                double straightness = 0);

  /// Nowhere in the cell is the interpolant's gradient longer.
  [[nodiscard]] double operator()(const CellField& field) const;

 private:
  void set_rows(std::span<const std::array<double, 3>> corners);

  CellKind kind_;
  std::array<double, 3> rows_{};  // linear: lengths of the rows of J^-1 are nowhere larger
  std::array<std::array<double, 3>, kMaxNodesPerCell> nodes_;  // of higher order
};

}  // namespace hiac
