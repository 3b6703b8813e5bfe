#pragma once

#include <algorithm>
#include <cmath>

namespace hiac::color_space {

/// A closed interval. Arithmetic is not rounded outward: a proof that uses it must add a margin for
/// rounding.
struct Interval {
  double low = 0;
  double high = 0;

  [[nodiscard]] double largest() const { return std::max(std::fabs(low), std::fabs(high)); }
};

inline Interval hull(Interval a, Interval b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}
inline Interval operator+(Interval a, Interval b) { return {a.low + b.low, a.high + b.high}; }
inline Interval operator-(Interval a) { return {-a.high, -a.low}; }
inline Interval operator*(Interval a, Interval b) {
  const auto [low, high] =
      std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return {low, high};
}

/// Bounds of a function of one variable u over an interval of u: the range of its values, the range
/// of its slopes (every generalised slope at a kink), and whether it is continuous there.
/// Arithmetic on it carries these through formulas: interval arithmetic with automatic
/// differentiation (R. E. Moore, "Interval Analysis", 1966, chapter 11).
struct Range {
  Interval value;
  Interval slope;
  bool continuous = true;

  Range() = default;
  Range(double constant) : value{constant, constant} {}  // NOLINT(google-explicit-constructor)
  Range(Interval values, Interval slopes, bool is_continuous = true)
      : value(values), slope(slopes), continuous(is_continuous) {}
};

inline Range operator+(const Range& a, const Range& b) {
  return {a.value + b.value, a.slope + b.slope, a.continuous && b.continuous};
}
inline Range operator-(const Range& a) { return {-a.value, -a.slope, a.continuous}; }
inline Range operator-(const Range& a, const Range& b) { return a + (-b); }
inline Range operator*(const Range& a, const Range& b) {
  return {a.value * b.value, a.slope * b.value + a.value * b.slope, a.continuous && b.continuous};
}
/// The divisor's values are positive.
inline Range operator/(const Range& a, const Range& b) {
  const Interval inverse{1 / b.value.high, 1 / b.value.low};
  return a * Range(inverse, -(b.slope * inverse * inverse), b.continuous);
}

// Functions on numbers and on ranges, so that one formula serves both. ---------------------------

inline double maximum(double a, double b) { return std::max(a, b); }
inline Range maximum(const Range& a, const Range& b) {
  if (a.value.low >= b.value.high) return a;
  if (b.value.low >= a.value.high) return b;
  return {{std::max(a.value.low, b.value.low), std::max(a.value.high, b.value.high)},
          hull(a.slope, b.slope),
          a.continuous && b.continuous};
}
template <typename T>
T minimum(const T& a, const T& b) {
  return -maximum(-a, -b);
}
template <typename T>
T absolute(const T& a) {
  return maximum(a, -a);
}
/// a, clamped to [0, 1].
template <typename T>
T unit_clamped(const T& a) {
  return maximum(T(0), minimum(T(1), a));
}

inline double sine(double a) { return std::sin(a); }
inline double cosine(double a) { return std::cos(a); }

/// Bounds the sine over an interval: it differs from the middle's sine by at most half the width.
inline Interval sine(Interval a) {
  const double middle = std::sin(0.5 * (a.low + a.high));
  const double half = 0.5 * (a.high - a.low);
  return {std::max(-1.0, middle - half), std::min(1.0, middle + half)};
}
inline Interval cosine(Interval a) {
  const double middle = std::cos(0.5 * (a.low + a.high));
  const double half = 0.5 * (a.high - a.low);
  return {std::max(-1.0, middle - half), std::min(1.0, middle + half)};
}
inline Range sine(const Range& a) {
  return {sine(a.value), cosine(a.value) * a.slope, a.continuous};
}
inline Range cosine(const Range& a) {
  return {cosine(a.value), -(sine(a.value) * a.slope), a.continuous};
}

/// Applies `below` up to and including the threshold and `above` beyond it; each is a pair of an
/// increasing function and its derivative, which is monotone.
template <typename Below, typename Above>
Range switched(const Range& a, double threshold, const Below& below, const Above& above) {
  const auto image = [&](const auto& branch, Interval x) {
    const auto [v0, d0] = branch(x.low);
    const auto [v1, d1] = branch(x.high);
    const Interval slopes = hull({d0, d0}, {d1, d1});
    return Range({v0, v1}, slopes * a.slope, a.continuous);
  };
  if (a.value.high <= threshold) return image(below, a.value);
  if (a.value.low > threshold) return image(above, a.value);
  const Range left = image(below, {a.value.low, threshold});
  const Range right = image(above, {threshold, a.value.high});
  return {hull(left.value, right.value), hull(left.slope, right.slope), false};
}
template <typename Below, typename Above>
double switched(double a, double threshold, const Below& below, const Above& above) {
  return a > threshold ? above(a).first : below(a).first;
}

}  // namespace hiac::color_space
