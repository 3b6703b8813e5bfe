#pragma once

#include <array>
#include <cmath>

namespace hiac {

/// A vector in extended precision: vector.hpp's operations with 64-bit mantissas.
using ExtendedVector = std::array<long double, 3>;

inline ExtendedVector minus(const ExtendedVector& a, const ExtendedVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline long double dot(const ExtendedVector& a, const ExtendedVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline ExtendedVector cross(const ExtendedVector& a, const ExtendedVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline long double length(const ExtendedVector& v) { return std::hypot(v[0], v[1], v[2]); }
inline std::array<double, 3> rounded(const ExtendedVector& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}
inline ExtendedVector unit(const ExtendedVector& v) {
  const long double size = length(v);
  return {v[0] / size, v[1] / size, v[2] / size};
}

}  // namespace hiac
