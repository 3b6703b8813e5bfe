#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "hiac/base/rounding.hpp"
#include "hiac/base/transfer_function.hpp"
#include "hiac/optics/bernstein.hpp"
#include "hiac/optics/polynomial_roots.hpp"

namespace hiac {

/// The rounding unit of a number. Nodes, weights and cosines are computed in extended precision:
/// rounded to double they are off by one unit of double, otherwise by a few of their own units, for
/// which 64 is a safe bound. Where long double is no finer than double, that holds for both.
template <class Real>
inline constexpr Real kRuleUnit = kUnitOf<Real>*(std::is_same_v<Real, double>&& kExtendedIsFiner
                                                     ? 1
                                                     : 64);
/// Differences and slopes of coefficients up to this size do not overflow.
inline constexpr double kLargestCoefficient = 1e150;

/// Where the segment is cut, and the effect of uncertain cuts: the integrals over t of the bounds
/// of each transfer function's error.
template <class Real>
struct Cuts {
  std::vector<Real> places;
  Real color_doubt = 0;
  Real extinction_doubt = 0;
};

/// A transfer function on one of its intervals: value + slope (s - anchor).
template <std::size_t N, class Real>
struct FunctionPiece {
  Real anchor;
  std::array<Real, N> value;
  std::array<Real, N> slope;

  [[nodiscard]] Real channel(std::size_t c, Real s) const {
    return value[c] + slope[c] * (s - anchor);
  }
};

/// A transfer function along a segment. Fields are measured relative to their value at the
/// segment's front, so that a small variation of large numbers keeps its digits.
template <std::size_t N, class Real>
struct Course {
  const BasicBernstein<Real>& field;
  const PiecewiseLinear<N>& function;
  BasicChebyshev<Real> variation;  ///< field - field(0)
  Real field_error = 0;            ///< bounds the rounding error of `variation` on a piece

  Course(const BasicBernstein<Real>& f, const PiecewiseLinear<N>& transfer_function)
      : field(f), function(transfer_function) {
    BasicBernstein<Real> shifted = f;
    Real largest = 0;
    for (std::size_t i = 0; i <= f.degree; ++i) {
      if (!(std::abs(f.c[i]) <= kLargestCoefficient))
        throw std::invalid_argument("a field along a ray must be finite and at most 1e150");
      shifted.c[i] -= f.c[0];
      largest = std::max(largest, std::abs(shifted.c[i]));
    }
    variation = chebyshev_from_bernstein(shifted);
    // a generous bound for a change of basis (n + 1 terms, whose factors add up to at most 2), a
    // transform (n + 1 terms, n + 1 coefficients) and Clenshaw's recurrence twice (errors up to n
    // times 4 n), each relative to `largest`
    const auto n = static_cast<Real>(f.degree);
    field_error = (1 + 3 * n + 4 * (n + 1) * (n + 1) + 8 * n * n) * kRuleUnit<Real> * largest;
  }

  /// Returns the function on interval k, as a function of the variation.
  [[nodiscard]] FunctionPiece<N, Real> shifted_piece(std::size_t k) const {
    const auto& given = function.piece(k);
    FunctionPiece<N, Real> p{given.anchor - field.c[0], {}, {}};
    std::copy(given.value.begin(), given.value.end(), p.value.begin());
    std::copy(given.slope.begin(), given.slope.end(), p.slope.begin());
    return p;
  }
};

/// Bounds of a transfer function's jump and bend at a breakpoint.
struct Break {
  double jump = 0;
  double bend = 0;
};

template <std::size_t N>
Break break_at(const PiecewiseLinear<N>& f, std::size_t k) {
  const double s = f.breakpoints()[k];
  const auto& before = f.piece(k);
  const auto& after = f.piece(k + 1);
  Break b;
  for (std::size_t c = 0; c < N; ++c) {
    b.jump = std::max(b.jump, std::abs(after.channel(c, s) - before.channel(c, s)));
    b.bend = std::max(b.bend, std::abs(after.slope[c] - before.slope[c]));
  }
  return b;
}

/// Adds the places where the field crosses breakpoints; returns the effect of their uncertainty.
template <std::size_t N, class Real>
Real add_cuts(const Course<N, Real>& course, std::vector<Real>& places) {
  const auto breakpoints = course.function.breakpoints();
  const auto [smallest, largest] = std::ranges::minmax(course.field.coefficients());
  Real doubt = 0;
  std::vector<BasicRootEnclosure<Real>> roots;
  const auto first = std::ranges::lower_bound(breakpoints, smallest);
  for (auto s = first; s != breakpoints.end() && *s <= largest; ++s) {
    roots.clear();
    append_roots(course.field, *s, roots);
    const Break b = break_at(course.function, static_cast<std::size_t>(s - breakpoints.begin()));
    for (const BasicRootEnclosure<Real>& root : roots) {
      places.push_back(static_cast<Real>(0.5) * (root.low + root.high));
      doubt += (root.high - root.low) * (b.jump + b.bend * root.deviation);
    }
  }
  return doubt;
}

/// Decides f(t) < s from differences of coefficients, which keep their sign however small they are.
template <class Real>
bool certainly_below(const BasicBernstein<Real>& f, Real t, double s) {
  BasicBernstein<Real> difference = f;
  for (std::size_t i = 0; i <= f.degree; ++i) difference.c[i] -= s;
  return evaluate(difference, t) < 0;
}

/// Returns the interval of the transfer function on a piece around t.
template <std::size_t N, class Real>
std::size_t interval_around(const Course<N, Real>& course, Real t) {
  const auto breakpoints = course.function.breakpoints();
  const auto interval_of = [&](Real s) {
    return static_cast<std::size_t>(std::ranges::upper_bound(breakpoints, s) - breakpoints.begin());
  };
  const auto [smallest, largest] = std::ranges::minmax(course.field.coefficients());
  std::size_t k = interval_of(smallest);
  if (k == interval_of(largest)) return k;
  k = interval_of(evaluate(course.field, t));
  while (k > 0 && certainly_below(course.field, t, breakpoints[k - 1])) --k;
  while (k < breakpoints.size() && !certainly_below(course.field, t, breakpoints[k])) ++k;
  return k;
}

}  // namespace hiac
