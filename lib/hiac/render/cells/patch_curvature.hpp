#pragma once

#include <cstddef>

#include "hiac/geometry/bezier_patch.hpp"

namespace hiac {

/// Bounds of the second derivatives of one coordinate of a patch, on its domain with a border
/// around it.
///
/// A second derivative of a Bernstein form of degree n in each parameter has second differences of
/// the form's coefficients as coefficients, times n (n - 1) or, of mixed ones, n n. On the unit
/// square the basis sums to one; on the square with a border of width h its absolute values sum to
/// at most (1 + 2 h)^n in each parameter. Triangles are a half of the square.
class PatchCurvature {
 public:
  /// How wide the border is.
  static constexpr double kBorder = 0x1p-5;

  PatchCurvature(std::size_t degree, const PatchNet<double>& net);

  /// How far the coordinate is at most from a linear one, up to this far in u and v from a place
  /// where the two touch, if that is in the border.
  [[nodiscard]] double within(double u, double v) const;

 private:
  double uu_ = 0, uv_ = 0, vv_ = 0;
};

}  // namespace hiac
