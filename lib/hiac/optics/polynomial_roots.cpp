// Based on: J. M. Lane, R. F. Riesenfeld, "Bounds on a Polynomial", BIT 21, 1981 (subdivision in
// Bernstein form). A part is halved until its coefficients are all of one certain sign (no root),
// or f is certainly monotone on it (one root, polished by Newton's method and enclosed by
// |t - root| <= |f(t) - s| / min |f'|), or f - s is all within its own rounding error (doubt).
#include "hiac/optics/polynomial_roots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hiac {
namespace {

constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;
constexpr double kSmallestWidth = 0x1p-50;

/// f - s on [low, low + width], its coefficients wrong by at most `margin` each.
struct Part {
  BernsteinPolynomial f;
  double low;
  double width;
  double margin;
};

double largest_magnitude(const BernsteinPolynomial& f) {
  double largest = 0;
  for (const double c : f.coefficients()) largest = std::max(largest, std::abs(c));
  return largest;
}

/// Error of evaluating f in [0, 1]: 2 n operations deep, each of relative error kUnit.
double evaluation_error(const BernsteinPolynomial& f) {
  return 4 * static_cast<double>(f.degree) * kUnit * largest_magnitude(f);
}

bool certainly_nonzero(const BernsteinPolynomial& f, double margin) {
  const auto [smallest, largest] = std::ranges::minmax(f.coefficients());
  return smallest > margin || largest < -margin;
}

/// Newton's method, kept in the bracket [0, 1] of a monotone f.
double monotone_root(const BernsteinPolynomial& f, const BernsteinPolynomial& slope) {
  const double direction = f.c[f.degree] > f.c[0] ? 1 : -1;
  double low = 0;
  double high = 1;
  double x = std::clamp(f.c[0] / (f.c[0] - f.c[f.degree]), 0.0, 1.0);
  for (int step = 0; step < 60; ++step) {
    const double value = evaluate(f, x);
    if (value == 0) break;
    (value * direction < 0 ? low : high) = x;
    double next = x - value / evaluate(slope, x);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double change = std::abs(next - x);
    x = next;
    if (change <= 2 * kUnit || high - low <= 2 * kUnit) break;
  }
  return x;
}

/// The root of a part on which f' is certainly nonzero.
RootEnclosure enclosed_simple_root(const Part& part, const BernsteinPolynomial& slope,
                                   double slope_margin) {
  double steepest = 0;
  double flattest = std::numeric_limits<double>::infinity();
  for (const double d : slope.coefficients()) {
    steepest = std::max(steepest, std::abs(d) + slope_margin);
    flattest = std::min(flattest, std::abs(d) - slope_margin);
  }
  const double x = monotone_root(part.f, slope);
  const double doubt = part.margin + evaluation_error(part.f);
  const double reach = (std::abs(evaluate(part.f, x)) + doubt) / flattest;
  const double t = part.low + part.width * x;
  const double half = part.width * reach + 2 * kUnit * t;
  const double low = std::max(t - half, part.low);
  const double high = std::min(t + half, part.low + part.width);
  return {low, std::max(low, high), doubt + steepest * 2 * half / part.width};
}

void isolate(const Part& part, std::vector<RootEnclosure>& roots) {
  if (certainly_nonzero(part.f, part.margin)) return;
  const double largest = largest_magnitude(part.f);
  if (largest <= 4 * part.margin || part.width <= kSmallestWidth) {
    roots.push_back({part.low, part.low + part.width, largest + part.margin});
    return;
  }
  const auto n = static_cast<double>(part.f.degree);
  const BernsteinPolynomial slope = derivative(part.f);
  const double slope_margin = 2 * n * part.margin + 4 * n * kUnit * largest;
  if (certainly_nonzero(slope, slope_margin)) {
    roots.push_back(enclosed_simple_root(part, slope, slope_margin));
    return;
  }
  // n averages deep, each wrong by kUnit of the largest coefficient at most
  const double margin =
      part.margin + n * kUnit * largest + std::numeric_limits<double>::denorm_min();
  const BernsteinHalves h = halves(part.f);
  const double half = 0.5 * part.width;
  isolate({h.front, part.low, half, margin}, roots);
  isolate({h.back, part.low + half, half, margin}, roots);
}

}  // namespace

void append_roots(const BernsteinPolynomial& f, double s, std::vector<RootEnclosure>& roots) {
  const auto [smallest, largest] = std::ranges::minmax(f.coefficients());
  if (smallest == largest || smallest > s || largest < s) return;
  Part whole{f, 0, 1, 0};
  for (std::size_t i = 0; i <= f.degree; ++i) whole.f.c[i] -= s;
  whole.margin = kUnit * largest_magnitude(whole.f);
  isolate(whole, roots);
}

}  // namespace hiac
