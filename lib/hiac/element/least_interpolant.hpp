#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace hiac {

/// The exponents of x, y and z in a monomial.
using Exponents = std::array<std::uint8_t, 3>;

/// The polynomial of least degree through values at points in space: the least interpolant (C. de
/// Boor, A. Ron, "On multivariate polynomial interpolation", Constructive Approximation 6, 1990;
/// "Computational aspects of polynomial interpolation in several variables", Mathematics of
/// Computation 58, 1992), modified so that it does not become unbounded for any position of the
/// points.
///
/// Let y be the coordinates in which the points have mean 0 and covariance 1. A functional is a
/// weighted sum of the values at the points. Its row holds its values on the monomials y^a /
/// sqrt(a!) of degree 5 at most, and the inner product of functionals is that of their rows. For
/// each degree k = 0 to 5, choose for the remaining functionals an orthonormal basis whose rows are
/// also orthogonal in degree k alone (a singular value decomposition). A functional whose row has
/// size s > t in degree k sees a form, the homogeneous polynomial with these coefficients; the
/// others remain for higher degrees. The interpolant is a sum of the forms that are seen; there are
/// as many as points.
///
/// With t = 0 this is de Boor and Ron's interpolant: it reproduces all polynomials of a degree if
/// the points determine them, and never raises the degree of a polynomial. But it divides by s,
/// which is close to 0 if the points are close to a position in which they do not see a form: cubic
/// wedges whose corners are a thousandth of their size off the reference cell's have interpolants a
/// thousand times their values. Here t is 1/4 in degrees above `complete`: a form with smaller s
/// counts as not seen. Up to degree `complete` it is 1e-10; with the degrees of
/// WorldPolynomial::complete_degree, s was above 0.15 there in all cells tried: corners of the
/// reference cell moved by up to 0.6 and its other nodes by up to 0.2, as long as they were not
/// turned inside out.
///
/// An affine map of the points rotates y, and thereby the rows, but leaves inner products of rows
/// unchanged: the interpolant of the image is the image of the interpolant.
struct LeastInterpolant {
  using Point = std::array<double, 3>;
  static constexpr std::size_t kMostPoints = 32;
  static constexpr std::size_t kMostDegree = 5;
  static constexpr std::size_t kMostTerms = 56;

  Point mean{};                        ///< of the points
  std::array<Point, 3> rows{};         ///< y_i = rows[i] . (x - mean)
  std::size_t degree = 0;              ///< of the forms seen
  std::array<double, kMostTerms> c{};  ///< of the monomials in y
};

/// The monomials of up to a degree, in the order of LeastInterpolant::c.
std::span<const Exponents> monomials(std::size_t degree);

/// The least interpolant through values at points; nothing if, to within 1e-10, the points lie in a
/// plane or polynomials of degree 5 do not separate them, because two of them coincide.
std::optional<LeastInterpolant> least_interpolant(std::span<const LeastInterpolant::Point> points,
                                                  std::span<const double> values,
                                                  std::size_t complete);

}  // namespace hiac
