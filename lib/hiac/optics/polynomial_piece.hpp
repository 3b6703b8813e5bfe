#pragma once

#include <array>

#include "hiac/base/glow.hpp"
#include "hiac/base/piecewise_linear.hpp"
#include "hiac/optics/bernstein.hpp"

namespace hiac {

/// A ray's segment inside one cell: the scalar fields along it, from t = 0 (front) to 1 (back).
/// `Real`, here and below: double or long double, in which all is computed.
template <class Real>
struct BasicPolynomialSegment {
  BasicBernstein<Real> color_field;       ///< what the colour function is applied to
  BasicBernstein<Real> extinction_field;  ///< what the extinction function is applied to
  Real length;                            ///< world units, >= 0
};
using PolynomialSegment = BasicPolynomialSegment<double>;

/// What a segment does to the light, with bounds of what is wrong with the numbers. The bounds
/// hold for the given coefficients, lengths and transfer functions taken as exact numbers.
template <class Real>
struct BasicSegmentRadiance {
  std::array<Real, 3> rgb;    ///< radiance leaving the front, nothing behind
  Real transparency;          ///< part of the light behind that passes
  double error;               ///< bound of the absolute error of every channel of rgb
  double transparency_error;  ///< bound of the absolute error of transparency
};
using SegmentRadiance = BasicSegmentRadiance<double>;

/// Radiance of a segment along which the fields are polynomials (design: polynomial pieces).
///
/// The segment is cut wherever a field takes a value at which its transfer function bends or jumps.
/// Between cuts the optical depth is integrated exactly, and the radiance by Gauss-Legendre rules
/// whose number of nodes follows from the error bound (64/15) M rho^(-2n) / (1 - rho^-2) on
/// Bernstein ellipses; pieces are bisected where that would take too many. `error` is the sum of
/// these bounds, each times the transparency in front of it, of rounding, and of doubts about cuts.
/// It is at most `tolerance` (absolute, > 0) plus the latter two. Rounding costs about 1e-14 of the
/// largest colour times the largest change of the optical depth that the field's variation could
/// cause; doubts about cuts cost less, unless a field grazes a jump to within rounding.
///
/// Where functions are so steep that the rounding of a field makes anything of the light, a piece
/// counts as linear from end to end, and `error` is infinite.
///
/// `extinction` must not be negative. Throws std::invalid_argument when a coefficient or the length
/// is not finite or absurdly large, the length is negative, the tolerance is not positive, the
/// extinction is negative, or the optical depth or colour is not finite.
SegmentRadiance integrate_segment(const PolynomialSegment& segment, const PiecewiseLinear<3>& color,
                                  const PiecewiseLinear<1>& extinction, Glow glow,
                                  double tolerance);

/// The same in extended precision; rounding costs 32 times less.
BasicSegmentRadiance<long double> integrate_segment(
    const BasicPolynomialSegment<long double>& segment, const PiecewiseLinear<3>& color,
    const PiecewiseLinear<1>& extinction, Glow glow, double tolerance);

}  // namespace hiac
