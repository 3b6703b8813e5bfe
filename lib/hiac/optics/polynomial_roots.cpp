// Based on: J. M. Lane, R. F. Riesenfeld, "Bounds on a Polynomial", BIT 21, 1981 (subdivision in
// Bernstein form). A part is halved until its coefficients certainly have one sign (no root), f is
// certainly monotone on it (one root, refined by Newton's method and enclosed by |t - root| <=
// |f(t) - s| / min |f'|), or f - s is within its own rounding error (doubt).
#include "hiac/optics/polynomial_roots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hiac {
namespace {

template <class Real>
constexpr Real kRootUnit = std::numeric_limits<Real>::epsilon() / 2;
template <class Real>
constexpr Real kSmallestWidth = 8 * kRootUnit<Real>;
// Fractions of a part's width. An enclosure of a simple root that is wider than the first is
// improved with the slope near the root; if it is wider than the second, the part is halved.
template <class Real>
constexpr Real kWide = 0x1p-30;
template <class Real>
constexpr Real kWidest = 0.125;

/// f - s on [low, low + width]; each coefficient has an error of at most `margin`.
template <class Real>
struct Part {
  BasicBernstein<Real> f;
  Real low;
  Real width;
  Real margin;
};

template <class Real>
Real largest_magnitude(const BasicBernstein<Real>& f) {
  Real largest = 0;
  for (const Real c : f.coefficients()) largest = std::max(largest, std::abs(c));
  return largest;
}

/// Bounds the error of evaluating f in [0, 1] (bernstein.hpp): its terms add up to at most the
/// largest.
template <class Real>
Real evaluation_error(const BasicBernstein<Real>& f) {
  return 4 * static_cast<Real>(f.degree) * kRootUnit<Real> * largest_magnitude(f);
}

template <class Real>
bool certainly_nonzero(const BasicBernstein<Real>& f, Real margin) {
  const auto [smallest, largest] = std::ranges::minmax(f.coefficients());
  return smallest > margin || largest < -margin;
}

/// Newton's method, kept in the bracket [0, 1] of a monotone f.
template <class Real>
Real monotone_root(const BasicBernstein<Real>& f, const BasicBernstein<Real>& slope) {
  const Real direction = f.c[f.degree] > f.c[0] ? 1 : -1;
  Real low = 0;
  Real high = 1;
  Real x = std::clamp<Real>(f.c[0] / (f.c[0] - f.c[f.degree]), 0, 1);
  for (int step = 0; step < 60; ++step) {
    const Real value = evaluate(f, x);
    if (value == 0) break;
    (value * direction < 0 ? low : high) = x;
    Real next = x - value / evaluate(slope, x);
    if (!(next > low && next < high)) next = static_cast<Real>(0.5) * (low + high);
    const Real change = std::abs(next - x);
    x = next;
    if (change <= 2 * kRootUnit<Real> || high - low <= 2 * kRootUnit<Real>) break;
  }
  return x;
}

/// Encloses the root of a part on which f' is certainly not zero.
template <class Real>
BasicRootEnclosure<Real> enclosed_simple_root(const Part<Real>& part,
                                              const BasicBernstein<Real>& slope,
                                              Real slope_margin) {
  Real steepest = 0;
  Real flattest = std::numeric_limits<Real>::infinity();
  for (const Real d : slope.coefficients()) {
    steepest = std::max(steepest, std::abs(d) + slope_margin);
    flattest = std::min(flattest, std::abs(d) - slope_margin);
  }
  const Real x = monotone_root(part.f, slope);
  const Real doubt = part.margin + evaluation_error(part.f);
  const Real residual = std::abs(evaluate(part.f, x)) + doubt;
  Real reach = residual / flattest;
  if (reach > kWide<Real> && slope.degree > 0) {
    // the slope at the root, minus its largest change within the enclosure
    const BasicBernstein<Real> bending = derivative(slope);
    Real bend = 0;
    for (const Real b : bending.coefficients()) bend = std::max(bend, std::abs(b));
    const Real nearby = std::abs(evaluate(slope, x)) - 2 * slope_margin - bend * reach;
    if (nearby > flattest) reach = residual / nearby;
  }
  const Real t = part.low + part.width * x;
  const Real half = part.width * reach + 2 * kRootUnit<Real> * t;
  const Real low = std::max(t - half, part.low);
  const Real high = std::min(t + half, part.low + part.width);
  return {low, std::max(low, high), doubt + steepest * 2 * half / part.width};
}

template <class Real>
void isolate(const Part<Real>& part, std::vector<BasicRootEnclosure<Real>>& roots) {
  if (certainly_nonzero(part.f, part.margin)) return;
  const Real largest = largest_magnitude(part.f);
  if (largest <= 4 * part.margin || part.width <= kSmallestWidth<Real>) {
    roots.push_back({part.low, part.low + part.width, largest + part.margin});
    return;
  }
  const auto n = static_cast<Real>(part.f.degree);
  const BasicBernstein<Real> slope = derivative(part.f);
  const Real slope_margin = 2 * n * part.margin + 4 * n * kRootUnit<Real> * largest;
  if (certainly_nonzero(slope, slope_margin)) {
    const BasicRootEnclosure<Real> root = enclosed_simple_root(part, slope, slope_margin);
    // the flattest slope may lie far from the root and be unrelated to it
    if (root.high - root.low <= kWidest<Real> * part.width) {
      roots.push_back(root);
      return;
    }
  }
  // n levels of averages, each with an error of up to kRootUnit<Real> of the largest coefficient
  const Real margin =
      part.margin + n * kRootUnit<Real> * largest + std::numeric_limits<Real>::denorm_min();
  const BernsteinHalves<Real> h = halves(part.f);
  const Real half = static_cast<Real>(0.5) * part.width;
  isolate(Part<Real>{h.front, part.low, half, margin}, roots);
  isolate(Part<Real>{h.back, part.low + half, half, margin}, roots);
}

}  // namespace

template <class Real>
void append_roots(const BasicBernstein<Real>& f, std::type_identity_t<Real> s,
                  std::vector<BasicRootEnclosure<Real>>& roots) {
  const auto [smallest, largest] = std::ranges::minmax(f.coefficients());
  if (smallest == largest || smallest > s || largest < s) return;
  Part<Real> whole{f, 0, 1, 0};
  for (std::size_t i = 0; i <= f.degree; ++i) whole.f.c[i] -= s;
  whole.margin = kRootUnit<Real> * largest_magnitude(whole.f);
  isolate(whole, roots);
}

template void append_roots(const BernsteinPolynomial&, double, std::vector<RootEnclosure>&);
template void append_roots(const ExtendedBernstein&, long double,
                           std::vector<BasicRootEnclosure<long double>>&);

}  // namespace hiac
