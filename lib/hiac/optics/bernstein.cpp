// Based on: R. T. Farouki, "The Bernstein polynomial basis: a centennial retrospective", Computer
// Aided Geometric Design 29, 2012; L. N. Trefethen, "Approximation Theory and Approximation
// Practice", 2013, chapters 3 and 8.
#include "hiac/optics/bernstein.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "hiac/base/binomial.hpp"

namespace hiac {
namespace {

void check_count(std::size_t count) {
  if (count == 0 || count > kMaxFieldDegree + 1)
    throw std::invalid_argument(
        fmt::format("a field along a ray needs 1 to {} coefficients", kMaxFieldDegree + 1));
}

constexpr std::size_t kCount = kMaxFieldDegree + 1;

/// For every degree n: the points cos(pi j / n), j = 0..n, and the matrix that turns the values
/// there into Chebyshev coefficients.
template <class Real>
struct InterpolationTables {
  std::array<std::array<Real, kCount>, kCount> points{};
  std::array<std::array<std::array<Real, kCount>, kCount>, kCount> transform{};

  InterpolationTables() {
    transform[0][0][0] = 1;
    for (std::size_t n = 1; n < kCount; ++n)
      for (std::size_t j = 0; j <= n; ++j) {
        points[n][j] = cosine(j, n);
        for (std::size_t k = 0; k <= n; ++k) {
          const Real ends = (k == 0 || k == n ? 0.5 : 1) * (j == 0 || j == n ? 0.5 : 1);
          transform[n][k][j] = 2 * ends * cosine(j * k, n) / static_cast<Real>(n);
        }
      }
  }

  /// cos(pi i / n), computed as a sine from the nearest quarter turn, so that symmetric points
  /// round symmetrically.
  static Real cosine(std::size_t i, std::size_t n) {
    const auto steps = static_cast<Real>(n) - 2.0 * static_cast<Real>(i % (2 * n));
    return std::sin(std::numbers::pi_v<Real> / 2 * steps / static_cast<Real>(n));
  }
};

template <class Real>
const InterpolationTables<Real>& tables() {
  static const InterpolationTables<Real> t;
  return t;
}

/// Binomial coefficients; all of these are exact in double.
constexpr auto kBinomials = [] {
  std::array<std::array<double, kMaxFieldDegree + 2>, kMaxFieldDegree + 2> table{};
  for (std::size_t n = 0; n < table.size(); ++n)
    for (std::size_t k = 0; k <= n; ++k)
      table[n][k] = k == 0 || k == n ? 1 : table[n - 1][k - 1] + table[n - 1][k];
  return table;
}();

/// Raises the degree by one; the function stays the same.
template <class Real>
void elevate(BasicCoefficients<Real>& c, std::size_t degree) {
  const auto n = static_cast<Real>(degree + 1);
  c[degree + 1] = c[degree];
  for (std::size_t i = degree; i > 0; --i) {
    const Real part = static_cast<Real>(i) / n;
    c[i] = part * c[i - 1] + (1 - part) * c[i];
  }
}

/// Conversions between the bases, for every degree n: from_chebyshev[n][k] holds the Bernstein
/// coefficients of T_k, to_chebyshev[n][i] the Chebyshev coefficients of the i-th Bernstein
/// polynomial.
template <class Real>
struct ConversionTables {
  using Matrix = std::array<std::array<Real, kCount>, kCount>;
  std::array<Matrix, kCount> from_chebyshev{}, to_chebyshev{};

  ConversionTables() {
    for (std::size_t n = 0; n < kCount; ++n)
      for (std::size_t k = 0; k <= n; ++k) {
        set_from(n, k);
        set_to(n, k);
      }
  }

 private:
  void set_from(std::size_t n, std::size_t k) {
    BasicCoefficients<Real> c{};  // of T_k, whose Bernstein coefficients are ratios of binomials
    for (std::size_t j = 0; j <= k; ++j)
      c[j] = ((k - j) % 2 == 0 ? 1 : -1) * static_cast<Real>(binomial(2 * k, 2 * j)) /
             static_cast<Real>(binomial(k, j));
    for (std::size_t degree = k; degree < n; ++degree) elevate(c, degree);
    std::copy_n(c.begin(), n + 1, from_chebyshev[n][k].begin());
  }

  // Sums cosines in extended precision.
  void set_to(std::size_t n, std::size_t i) {
    to_chebyshev[n][i][0] = 1;
    if (n == 0) return;
    const long double step = std::numbers::pi_v<long double> / static_cast<long double>(n);
    const auto at = [step](std::size_t j) { return std::cos(step * static_cast<long double>(j)); };
    for (std::size_t k = 0; k <= n; ++k) {
      long double sum = 0;
      for (std::size_t j = 0; j <= n; ++j) {
        const long double t = (1 + at(j)) / 2;
        const long double value = static_cast<long double>(binomial(n, i)) *
                                  std::pow(t, static_cast<long double>(i)) *
                                  std::pow(1 - t, static_cast<long double>(n - i));
        sum += (j == 0 || j == n ? 0.5L : 1) * value * at(j * k % (2 * n));
      }
      to_chebyshev[n][i][k] =
          static_cast<Real>((k == 0 || k == n ? 1 : 2) * sum / static_cast<long double>(n));
    }
  }
};

template <class Real>
const ConversionTables<Real>& conversions() {
  static const ConversionTables<Real> t;
  return t;
}

}  // namespace

template <class Real>
BasicBernstein<Real>::BasicBernstein(std::span<const Real> coefficients) {
  check_count(coefficients.size());
  std::copy(coefficients.begin(), coefficients.end(), c.begin());
  degree = coefficients.size() - 1;
}

template <class Real>
Real evaluate(const BasicBernstein<Real>& f, std::type_identity_t<Real> t) {
  const std::size_t n = f.degree;
  if (n == 0) return f.c[0];
  const Real s = 1 - t;
  Real power = 1, sum = f.c[0] * s;
  for (std::size_t i = 1; i < n; ++i) {
    power *= t;
    sum = (sum + power * (kBinomials[n][i] * f.c[i])) * s;
  }
  return sum + power * t * f.c[n];
}

template <class Real>
BernsteinHalves<Real> halves(const BasicBernstein<Real>& f) {
  BernsteinHalves<Real> h;
  h.front.degree = f.degree;
  h.back.degree = f.degree;
  BasicCoefficients<Real> c = f.c;
  for (std::size_t n = f.degree;; --n) {
    h.front.c[f.degree - n] = c[0];
    h.back.c[n] = c[n];
    if (n == 0) return h;
    for (std::size_t i = 0; i < n; ++i) c[i] = static_cast<Real>(0.5) * (c[i] + c[i + 1]);
  }
}

template <class Real>
BasicBernstein<Real> derivative(const BasicBernstein<Real>& f) {
  BasicBernstein<Real> d;
  if (f.degree == 0) return d;
  d.degree = f.degree - 1;
  for (std::size_t i = 0; i < f.degree; ++i)
    d.c[i] = static_cast<Real>(f.degree) * (f.c[i + 1] - f.c[i]);
  return d;
}

template <class Real>
Real evaluate(const BasicChebyshev<Real>& f, std::type_identity_t<Real> x) {
  Real following = 0;
  Real current = 0;
  for (std::size_t k = f.degree; k > 0; --k) {
    const Real previous = 2 * x * current - following + f.c[k];
    following = current;
    current = previous;
  }
  return x * current - following + f.c[0];
}

template <class Real>
BasicBernsteinEllipse<Real>::BasicBernsteinEllipse(double rho) {
  const double inverse = 1 / rho;
  Real power = 1, inverse_power = 1;
  for (Real& value : largest) {
    value = static_cast<Real>(0.5) * (power + inverse_power);
    power *= rho;
    inverse_power *= inverse;
  }
}

template <class Real>
Real ellipse_bound(const BasicChebyshev<Real>& f, const BasicBernsteinEllipse<Real>& ellipse,
                   std::size_t first) {
  Real sum = 0;
  for (std::size_t k = first; k <= f.degree; ++k) sum += std::abs(f.c[k]) * ellipse.largest[k];
  return sum;
}

template <class Real>
Real magnitude_sum(const BasicChebyshev<Real>& f, std::size_t first) {
  Real sum = 0;
  for (std::size_t k = first; k <= f.degree; ++k) sum += std::abs(f.c[k]);
  return sum;
}

template <class Real>
BasicChebyshev<Real> chebyshev_from_bernstein(const BasicBernstein<Real>& f) {
  BasicChebyshev<Real> p;
  p.degree = f.degree;
  const auto& matrix = conversions<Real>().to_chebyshev[f.degree];
  for (std::size_t i = 0; i <= f.degree; ++i)
    for (std::size_t k = 0; k <= f.degree; ++k) p.c[k] += f.c[i] * matrix[i][k];
  return p;
}

namespace {

template <class Real>
BasicBernstein<Real> from_chebyshev(std::span<const Real> coefficients) {
  check_count(coefficients.size());
  BasicBernstein<Real> f;
  f.degree = coefficients.size() - 1;
  const auto& matrix = conversions<Real>().from_chebyshev[f.degree];
  for (std::size_t k = 0; k <= f.degree; ++k)
    for (std::size_t j = 0; j <= f.degree; ++j) f.c[j] += coefficients[k] * matrix[k][j];
  return f;
}

}  // namespace

BernsteinPolynomial bernstein_from_chebyshev(std::span<const double> coefficients) {
  return from_chebyshev(coefficients);
}
ExtendedBernstein bernstein_from_chebyshev(std::span<const long double> coefficients) {
  return from_chebyshev(coefficients);
}

BernsteinPolynomial bernstein_from_powers(std::span<const double> coefficients) {
  check_count(coefficients.size());
  BernsteinPolynomial f;
  f.c[0] = coefficients.back();
  for (std::size_t k = coefficients.size() - 1; k-- > 0;) {
    // Horner's scheme: multiply by x, which is -1 at t = 0 and 1 at t = 1, then add a coefficient
    const std::size_t n = ++f.degree;
    for (std::size_t i = n + 1; i-- > 0;) {
      const double before = i > 0 ? static_cast<double>(i) * f.c[i - 1] : 0;
      const double here = i < n ? static_cast<double>(n - i) * f.c[i] : 0;
      f.c[i] = (before - here) / static_cast<double>(n) + coefficients[k];
    }
  }
  return f;
}

template <class Real>
BasicChebyshev<Real> chebyshev_interpolant(const BasicCoefficients<Real>& values, std::size_t n) {
  BasicChebyshev<Real> p;
  p.degree = n;
  const auto& transform = tables<Real>().transform[n];
  for (std::size_t k = 0; k <= n; ++k)
    for (std::size_t j = 0; j <= n; ++j) p.c[k] += transform[k][j] * values[j];
  return p;
}

template <class Real>
Real chebyshev_point(std::size_t j, std::size_t n) {
  return (1 + tables<Real>().points[n][j]) / 2;
}

template <class Real>
BasicChebyshev<Real> restricted(const BasicChebyshev<Real>& f, std::type_identity_t<Real> t0,
                                std::type_identity_t<Real> t1) {
  if (t0 == 0 && t1 == 1) return f;
  BasicCoefficients<Real> values{};
  const std::size_t n = f.degree;
  const Real middle = t0 + t1 - 1;  // in the coordinate x of f
  const Real half = t1 - t0;
  const auto& points = tables<Real>().points[n];
  for (std::size_t j = 0; j <= n; ++j) values[j] = evaluate(f, middle + half * points[j]);
  return chebyshev_interpolant(values, n);
}

template struct BasicBernstein<double>;
template double evaluate(const BernsteinPolynomial&, double);
template BernsteinHalves<double> halves(const BernsteinPolynomial&);
template BernsteinPolynomial derivative(const BernsteinPolynomial&);
template double evaluate(const ChebyshevPolynomial&, double);
template struct BasicBernsteinEllipse<double>;
template double ellipse_bound(const ChebyshevPolynomial&, const BasicBernsteinEllipse<double>&,
                              std::size_t);
template double magnitude_sum(const ChebyshevPolynomial&, std::size_t);
template ChebyshevPolynomial chebyshev_from_bernstein(const BernsteinPolynomial&);
template ChebyshevPolynomial chebyshev_interpolant(const BasicCoefficients<double>&, std::size_t);
template double chebyshev_point(std::size_t, std::size_t);
template ChebyshevPolynomial restricted(const ChebyshevPolynomial&, double, double);

template struct BasicBernstein<long double>;
template long double evaluate(const ExtendedBernstein&, long double);
template BernsteinHalves<long double> halves(const ExtendedBernstein&);
template ExtendedBernstein derivative(const ExtendedBernstein&);
template long double evaluate(const BasicChebyshev<long double>&, long double);
template struct BasicBernsteinEllipse<long double>;
template long double ellipse_bound(const BasicChebyshev<long double>&,
                                   const BasicBernsteinEllipse<long double>&, std::size_t);
template long double magnitude_sum(const BasicChebyshev<long double>&, std::size_t);
template BasicChebyshev<long double> chebyshev_from_bernstein(const ExtendedBernstein&);
template BasicChebyshev<long double> chebyshev_interpolant(const BasicCoefficients<long double>&,
                                                           std::size_t);
template long double chebyshev_point(std::size_t, std::size_t);
template BasicChebyshev<long double> restricted(const BasicChebyshev<long double>&, long double,
                                                long double);

}  // namespace hiac
