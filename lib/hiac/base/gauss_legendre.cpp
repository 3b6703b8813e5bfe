#include "hiac/base/gauss_legendre.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace hiac {
namespace {

template <class Real>
struct Tables {
  std::array<std::array<Real, kMaxGaussNodes>, kMaxGaussNodes + 1> nodes{};
  std::array<std::array<Real, kMaxGaussNodes>, kMaxGaussNodes + 1> weights{};
};

struct LegendreValue {
  long double value;
  long double derivative;
};

/// P_n(x) and P_n'(x), |x| < 1, by the three-term recurrence.
LegendreValue legendre(std::size_t n, long double x) {
  long double previous = 1;
  long double current = x;
  for (std::size_t k = 2; k <= n; ++k) {
    const auto m = static_cast<long double>(k);
    const long double following = ((2 * m - 1) * x * current - (m - 1) * previous) / m;
    previous = current;
    current = following;
  }
  return {current, static_cast<long double>(n) * (x * current - previous) / (x * x - 1)};
}

/// Newton's method from Tricomi's estimate of the i-th largest node.
long double node(std::size_t n, std::size_t i) {
  if (2 * i + 1 == n) return 0;
  long double x = std::cos(std::numbers::pi_v<long double> * (static_cast<long double>(i) + 0.75L) /
                           (static_cast<long double>(n) + 0.5L));
  for (int step = 0; step < 8; ++step) {
    const LegendreValue p = legendre(n, x);
    x -= p.value / p.derivative;
  }
  return x;
}

template <class Real>
Tables<Real> build_tables() {
  Tables<Real> t;
  for (std::size_t n = 1; n <= kMaxGaussNodes; ++n)
    for (std::size_t i = 0; i < n; ++i) {
      const long double x = node(n, i);
      const long double slope = legendre(n, x).derivative;
      t.nodes[n][n - 1 - i] = static_cast<Real>(x);
      t.weights[n][n - 1 - i] = static_cast<Real>(2 / ((1 - x * x) * slope * slope));
    }
  return t;
}

template <class Real>
BasicGaussRule<Real> rule(std::size_t n) {
  static const Tables<Real> tables = build_tables<Real>();
  return {std::span(tables.nodes[n]).first(n), std::span(tables.weights[n]).first(n)};
}

}  // namespace

GaussRule gauss_legendre(std::size_t n) { return rule<double>(n); }

BasicGaussRule<long double> extended_gauss_legendre(std::size_t n) { return rule<long double>(n); }

}  // namespace hiac
