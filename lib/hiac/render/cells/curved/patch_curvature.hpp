#pragma once

#include <cstddef>

#include "hiac/geometry/bezier_patch.hpp"

namespace hiac {

/// Bounds of the second derivatives of one coordinate of a patch, on its domain with a border
/// around it.
///
/// The coefficients of a second derivative of a Bernstein form of degree n in each parameter are
/// second differences of the form's coefficients, times n (n - 1), or n n for the mixed derivative.
/// On the unit square the basis sums to one; on the square with a border of width h its absolute
/// values sum to at most (1 + 2 h)^n in each parameter. Triangles are half of the square.
class PatchCurvature {
 public:
  /// The width of the border.
  static constexpr double kBorder = 0x1p-5;

  PatchCurvature(std::size_t degree, const PatchNet<double>& net);

  /// A bound of the coordinate's distance from its tangent at a point, up to `u` and `v` away from
  /// that point, as long as the domain with its border is not left.
  [[nodiscard]] double within(double u, double v) const;

 private:
  double uu_ = 0, uv_ = 0, vv_ = 0;
};

}  // namespace hiac
