#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "hiac/geometry/predicates.hpp"

namespace hiac {

/// A vector in world coordinates, with ordinary rounding: for what need not be exact.
using Vector = std::array<double, 3>;

inline Vector minus(Point3 a, Point3 b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The Euclidean length, without intermediate overflow or underflow.
inline double length(const Vector& v) { return std::hypot(v[0], v[1], v[2]); }
/// The vector of length 1 in the same direction. v must not be zero.
inline Vector unit(const Vector& v) {
  const double size = length(v);
  return {v[0] / size, v[1] / size, v[2] / size};
}
/// The largest magnitude of a component.
inline double largest(const Vector& v) {
  return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

}  // namespace hiac
