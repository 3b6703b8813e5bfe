#pragma once

#include <array>
#include <span>

#include "hiac/element/cell_field.hpp"

namespace hiac {

/// A proven bound of the gradients of isoparametric interpolants of fields in one cell. In cells of
/// higher order it is that of curved_gradient_bound.hpp. In linear cells:
///
/// The gradient is J^-T g, with J the Jacobian of the cell's map and g the field's derivatives in
/// reference coordinates. Cells are images of a cube with parameters u, v, w (a triangle is a
/// collapsed square; in pyramids and wedges, the factor with which the collapsing column and
/// derivative vanish is divided out of both). There the columns of J and g are combinations, with
/// weights >= 0 that sum to at most one, of their values at the cube's corners: differences of
/// neighbouring corners of the cell. So g and the rows' numerators are bounded by the largest of
/// these differences and of their cross products; and det J is no smaller than the least of its
/// Bernstein coefficients on the cube. If these do not all have one sign, nothing is proven, and
/// the bound is infinite. The bound includes rounding.
class GradientBound {
 public:
  /// `nodes`: positions of the kind's nodes, in their order; edges whose edge_deviation is at most
  /// `straightness` are taken as straight, as in CellMap.
  GradientBound(CellKind kind, std::span<const std::array<double, 3>> nodes,
                double straightness = 0);

  /// An upper bound of the length of the interpolant's gradient in the cell.
  [[nodiscard]] double operator()(const CellField& field) const;

 private:
  void set_rows(std::span<const std::array<double, 3>> corners);

  CellKind kind_;
  std::array<double, 3> rows_{};  // linear cells: bounds of the lengths of the rows of J^-1
  std::array<std::array<double, 3>, kMaxNodesPerCell> nodes_;  // if of higher order
};

}  // namespace hiac
