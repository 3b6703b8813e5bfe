#pragma once

#include <array>

#include "hiac/base/transfer_function.hpp"
#include "hiac/optics/bernstein.hpp"

namespace hiac {

/// A ray's segment inside one cell: the scalar fields along it, from t = 0 (front) to 1 (back).
/// `Real`, here and below, is double or long double, the type of all arithmetic.
template <class Real>
struct BasicPolynomialSegment {
  BasicBernstein<Real> color_field;       ///< the argument of the colour function
  BasicBernstein<Real> extinction_field;  ///< the argument of the extinction function
  Real length;                            ///< world units, >= 0
};
using PolynomialSegment = BasicPolynomialSegment<double>;

/// The effect of a segment on the light, with error bounds. The bounds hold for the given
/// coefficients, lengths and transfer functions taken as exact numbers.
template <class Real>
struct BasicSegmentRadiance {
  std::array<Real, 3> rgb;    ///< radiance that leaves the front with nothing behind
  Real transparency;          ///< fraction of the light behind that passes
  double error;               ///< bound of the absolute error of every channel of rgb
  double transparency_error;  ///< bound of the absolute error of transparency
};
using SegmentRadiance = BasicSegmentRadiance<double>;

/// Returns the radiance of a segment along which the fields are polynomials.
///
/// The segment is cut wherever a field takes a value at which its transfer function bends or jumps.
/// Between cuts the optical depth is integrated exactly, and the radiance by Gauss-Legendre rules
/// whose number of nodes follows from the error bound (64/15) M rho^(-2n) / (1 - rho^-2) on
/// Bernstein ellipses; pieces that need too many nodes are bisected. `error` is the sum of these
/// bounds, each times the transparency in front of it, of rounding errors, and of the effect of
/// uncertain cuts. It is at most `tolerance` (absolute, > 0) plus the latter two. Rounding
/// contributes about 1e-14 of the largest colour times the largest change of the optical depth that
/// the field's variation could cause; uncertain cuts contribute less, unless a field grazes a jump
/// to within rounding.
///
/// If functions are so steep that rounding errors of a field make the light meaningless, a piece
/// counts as linear from end to end, and `error` is infinite.
///
/// Throws std::invalid_argument if a coefficient is not finite or exceeds 1e150 in magnitude, if
/// the length is negative, not finite or above 1e150, the tolerance is not positive, the extinction
/// is negative, or the optical depth or colour is not finite.
SegmentRadiance integrate_segment(const PolynomialSegment& segment, const PiecewiseLinear<3>& color,
                                  const PiecewiseLinear<1>& extinction, Glow glow,
                                  double tolerance);

/// Computes the same in extended precision; rounding errors are 32 times smaller.
BasicSegmentRadiance<long double> integrate_segment(
    const BasicPolynomialSegment<long double>& segment, const PiecewiseLinear<3>& color,
    const PiecewiseLinear<1>& extinction, Glow glow, double tolerance);

}  // namespace hiac
