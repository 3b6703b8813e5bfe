#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

namespace hiac {

/// The largest degree of a field along a ray that the optics support.
inline constexpr std::size_t kMaxFieldDegree = 20;

/// Coefficients of a polynomial of degree `degree`; later entries are unused, and there is room for
/// the integral of a field. `Real`, here and below, is double or long double, the type of all
/// arithmetic.
template <class Real>
using BasicCoefficients = std::array<Real, kMaxFieldDegree + 2>;

/// f(t) = sum_i c[i] binomial(n, i) t^i (1 - t)^(n-i) on [0, 1]. f lies between the smallest and
/// the largest coefficient, c[0] = f(0), c[n] = f(1).
template <class Real>
struct BasicBernstein {
  BasicCoefficients<Real> c{};
  std::size_t degree = 0;

  BasicBernstein() = default;
  /// Throws std::invalid_argument if there are no coefficients or more than kMaxFieldDegree + 1.
  explicit BasicBernstein(std::span<const Real> coefficients);

  [[nodiscard]] std::span<const Real> coefficients() const { return {c.data(), degree + 1}; }
};
using BernsteinPolynomial = BasicBernstein<double>;
using ExtendedBernstein = BasicBernstein<long double>;

/// Returns f(t) for t in [0, 1], by Horner's scheme in powers of t and 1 - t: no term exceeds its
/// value in exact arithmetic by more than 4 degree units of rounding.
template <class Real>
Real evaluate(const BasicBernstein<Real>& f, std::type_identity_t<Real> t);

/// f on [0, 1/2] and on [1/2, 1], each as a polynomial on [0, 1].
template <class Real>
struct BernsteinHalves {
  BasicBernstein<Real> front;
  BasicBernstein<Real> back;
};
template <class Real>
BernsteinHalves<Real> halves(const BasicBernstein<Real>& f);

/// f'.
template <class Real>
BasicBernstein<Real> derivative(const BasicBernstein<Real>& f);

/// f(x) = sum_k c[k] T_k(x) on [-1, 1].
template <class Real>
struct BasicChebyshev {
  BasicCoefficients<Real> c{};
  std::size_t degree = 0;
};
using ChebyshevPolynomial = BasicChebyshev<double>;

/// f(x), by Clenshaw's recurrence.
template <class Real>
Real evaluate(const BasicChebyshev<Real>& f, std::type_identity_t<Real> x);

/// A Bernstein ellipse: foci -1 and 1, semi-axes summing to rho >= 1. rho = 1 is [-1, 1] itself.
template <class Real>
struct BasicBernsteinEllipse {
  BasicCoefficients<Real> largest{};  ///< of |T_k| on the ellipse, (rho^k + rho^-k) / 2

  explicit BasicBernsteinEllipse(double rho);
};

/// sum_{k >= first} |c[k]| max |T_k|: with first = 0 a bound of |f| on the ellipse.
template <class Real>
Real ellipse_bound(const BasicChebyshev<Real>& f, const BasicBernsteinEllipse<Real>& ellipse,
                   std::size_t first);

/// sum_{k >= first} |c[k]|: with first = 0 a bound of |f| on [-1, 1].
template <class Real>
Real magnitude_sum(const BasicChebyshev<Real>& f, std::size_t first);

/// Converts f(t) with t = (1 + x) / 2 into a function of x.
template <class Real>
BasicChebyshev<Real> chebyshev_from_bernstein(const BasicBernstein<Real>& f);

/// Converts sum_k c[k] T_k(x), x = 2 t - 1, into a function of t. The factors of the coefficient of
/// degree k reach about 2^k, so that rounding errors grow unless the coefficients decay. Throws
/// std::invalid_argument if there are no coefficients or more than kMaxFieldDegree + 1.
BernsteinPolynomial bernstein_from_chebyshev(std::span<const double> coefficients);
ExtendedBernstein bernstein_from_chebyshev(std::span<const long double> coefficients);

/// Converts sum_k c[k] x^k, x = 2 t - 1, into a function of t. No coefficient of the result exceeds
/// the sum of all |c[k]|. Throws std::invalid_argument if there are no coefficients or more than
/// kMaxFieldDegree + 1.
BernsteinPolynomial bernstein_from_powers(std::span<const double> coefficients);

/// Returns the polynomial of degree n < `values`' size with these values at the Chebyshev points
/// x = cos(pi j / n), j = 0..n.
template <class Real>
BasicChebyshev<Real> chebyshev_interpolant(const BasicCoefficients<Real>& values, std::size_t n);
/// Returns the Chebyshev point j as t = (1 + cos(pi j / n)) / 2.
template <class Real>
Real chebyshev_point(std::size_t j, std::size_t n);

/// Restricts f, given on t in [0, 1], to [t0, t1]: x = -1 at t0, x = 1 at t1.
template <class Real>
BasicChebyshev<Real> restricted(const BasicChebyshev<Real>& f, std::type_identity_t<Real> t0,
                                std::type_identity_t<Real> t1);

}  // namespace hiac
