#pragma once

#include <array>

#include <gmpxx.h>

namespace hiac::test {

using RationalVector = std::array<mpq_class, 3>;

/// A double is a rational number: nothing is rounded.
inline RationalVector rational(const std::array<double, 3>& p) {
  return {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])};
}

inline RationalVector operator-(const RationalVector& a, const RationalVector& b) {
  return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}

/// det[u, v, w] by Sarrus' rule.
inline mpq_class determinant(const RationalVector& u, const RationalVector& v,
                             const RationalVector& w) {
  return u[0] * v[1] * w[2] + u[1] * v[2] * w[0] + u[2] * v[0] * w[1] - u[2] * v[1] * w[0] -
         u[1] * v[0] * w[2] - u[0] * v[2] * w[1];
}

/// The sign of det[b - a, c - a, d - a].
inline int rational_orientation(const std::array<double, 3>& a, const std::array<double, 3>& b,
                                const std::array<double, 3>& c, const std::array<double, 3>& d) {
  const RationalVector origin = rational(a);
  return sgn(determinant(rational(b) - origin, rational(c) - origin, rational(d) - origin));
}

/// The sign of det[b - a, c - a, v].
inline int rational_orientation_towards(const std::array<double, 3>& a,
                                        const std::array<double, 3>& b,
                                        const std::array<double, 3>& c,
                                        const std::array<double, 3>& v) {
  const RationalVector origin = rational(a);
  return sgn(determinant(rational(b) - origin, rational(c) - origin, rational(v)));
}

}  // namespace hiac::test
