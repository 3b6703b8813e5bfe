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
/// Computation 58, 1992), made to depend on the points without jumps to infinity.
///
/// Let y be the coordinates in which the points have mean 0 and covariance 1. A functional is a
/// weighted sum of the values at the points; what it makes of the monomials y^a / sqrt(a!) of
/// degree 5 at most is its row, and rows say what is orthogonal and what has size 1. Degree by
/// degree, k = 0 to 5, take from the functionals that are left an orthonormal basis whose rows are
/// orthogonal in degree k alone, too (a singular value decomposition). A functional whose row has
/// size s > t there sees a form, the homogeneous polynomial of these coefficients; the others are
/// left for higher degrees. The interpolant is sought among sums of the forms that are seen, which
/// are as many as the points.
///
/// With t = 0 that is de Boor and Ron's: it has all polynomials of a degree if the points determine
/// these, and of a polynomial's values it makes one of no higher degree. But it divides by s, which
/// comes near 0 where points nearly lie so that they do not see a form: cubic wedges whose corners
/// are a thousandth of their size off the reference cell's have interpolants a thousand times their
/// values. Here t is 1/4 in degrees above `complete`: a form that is seen by less counts as not
/// seen. Up to degree `complete` it is 1e-10; with the degrees of WorldPolynomial::complete_degree,
/// s was above 0.15 there in all cells tried: corners of the reference cell moved by up to 0.6 and
/// its other nodes by up to 0.2, as long as they were not turned inside out.
///
/// An affine map of the points turns y, as a rotation does, and thereby turns rows, but no product
/// of two: the interpolant of the image is the image of the interpolant.
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

/// The monomials of a degree or less, in the order of LeastInterpolant::c.
std::span<const Exponents> monomials(std::size_t degree);

/// Nothing where, to within 1e-10, the points lie in a plane or polynomials of degree 5 do not tell
/// them apart: two of them coincide.
std::optional<LeastInterpolant> least_interpolant(std::span<const LeastInterpolant::Point> points,
                                                  std::span<const double> values,
                                                  std::size_t complete);

}  // namespace hiac
