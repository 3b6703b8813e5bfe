#pragma once

#include <array>
#include <cmath>
#include <span>

namespace hiac::test {

/// Vectors of the references that pictures are held against: 64-bit mantissas, operators.
using ExtendedVec = std::array<long double, 3>;

inline ExtendedVec operator-(const ExtendedVec& a, const ExtendedVec& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline ExtendedVec operator+(const ExtendedVec& a, const ExtendedVec& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline ExtendedVec operator*(long double s, const ExtendedVec& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
inline long double dot(const ExtendedVec& a, const ExtendedVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline ExtendedVec cross(const ExtendedVec& a, const ExtendedVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline long double norm(const ExtendedVec& a) { return std::sqrt(dot(a, a)); }
inline ExtendedVec unit(const ExtendedVec& a) { return (1 / norm(a)) * a; }
inline ExtendedVec vec(std::span<const double, 3> a) { return {a[0], a[1], a[2]}; }

}  // namespace hiac::test
