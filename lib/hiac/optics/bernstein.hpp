#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace hiac {

/// Largest degree of a field along a ray that the optics take.
inline constexpr std::size_t kMaxFieldDegree = 16;

/// Coefficients of a polynomial of degree `degree`, entries beyond it unused; there is room for the
/// integral of a field.
using PolynomialCoefficients = std::array<double, kMaxFieldDegree + 2>;

/// f(t) = sum_i c[i] binomial(n, i) t^i (1 - t)^(n-i) on [0, 1]. f lies between the smallest and
/// the largest coefficient, c[0] = f(0), c[n] = f(1).
struct BernsteinPolynomial {
  PolynomialCoefficients c{};
  std::size_t degree = 0;

  BernsteinPolynomial() = default;
  /// Throws std::invalid_argument when there is no coefficient or more than kMaxFieldDegree + 1.
  explicit BernsteinPolynomial(std::span<const double> coefficients);

  [[nodiscard]] std::span<const double> coefficients() const { return {c.data(), degree + 1}; }
};

/// f(t), by de Casteljau's algorithm.
double evaluate(const BernsteinPolynomial& f, double t);

/// f on [0, 1/2] and on [1/2, 1], each as a polynomial on [0, 1].
struct BernsteinHalves {
  BernsteinPolynomial front;
  BernsteinPolynomial back;
};
BernsteinHalves halves(const BernsteinPolynomial& f);

/// f'.
BernsteinPolynomial derivative(const BernsteinPolynomial& f);

/// f(x) = sum_k c[k] T_k(x) on [-1, 1].
struct ChebyshevPolynomial {
  PolynomialCoefficients c{};
  std::size_t degree = 0;
};

/// f(x), by Clenshaw's recurrence.
double evaluate(const ChebyshevPolynomial& f, double x);

/// sum_{k >= first} |c[k]| (rho^k + rho^-k) / 2: with first = 0 a bound of |f| on the Bernstein
/// ellipse of parameter rho >= 1 (foci -1 and 1, semi-axes summing to rho).
double ellipse_bound(const ChebyshevPolynomial& f, double rho, std::size_t first);

/// The same function, with t = (1 + x) / 2.
ChebyshevPolynomial chebyshev_from_bernstein(const BernsteinPolynomial& f);

/// The same function, with t = (1 + x) / 2. A coefficient of degree k enters with factors up to
/// about 2^k, so rounding errors grow with coefficients that do not fall off.
/// Throws std::invalid_argument when there is no coefficient or more than kMaxFieldDegree + 1.
BernsteinPolynomial bernstein_from_chebyshev(std::span<const double> coefficients);

/// f, given on [0, 1] by t = (1 + x) / 2, on [t0, t1] alone: x = -1 at t0, x = 1 at t1.
ChebyshevPolynomial restricted(const ChebyshevPolynomial& f, double t0, double t1);

}  // namespace hiac
