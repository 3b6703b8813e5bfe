#include "hiac/geometry/exact_determinant.hpp"

#include <array>

#include <CGAL/Mpzf.h>

// CGAL's kernel and number types are LGPL; nothing of its GPL parts is used here.

namespace hiac {
namespace {

using Exact = CGAL::Mpzf;  // a ring: sums, differences and products of doubles without rounding
using ExactVector = std::array<Exact, 3>;

ExactVector exact(std::span<const double, 3> p) { return {Exact(p[0]), Exact(p[1]), Exact(p[2])}; }

ExactVector exact_difference(std::span<const double, 3> p, std::span<const double, 3> q) {
  return {Exact(p[0]) - Exact(q[0]), Exact(p[1]) - Exact(q[1]), Exact(p[2]) - Exact(q[2])};
}  // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks): the ring's numbers own their memory

int sign_of_determinant(const ExactVector& u, const ExactVector& v, const ExactVector& w) {
  const Exact determinant = u[0] * (v[1] * w[2] - v[2] * w[1]) +
                            u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
  return static_cast<int>(CGAL::sign(determinant));
}

}  // namespace

int exact_orientation(std::span<const double, 3> a, std::span<const double, 3> b,
                      std::span<const double, 3> c, std::span<const double, 3> d) {
  return sign_of_determinant(exact_difference(b, a), exact_difference(c, a),
                             exact_difference(d, a));
}

int exact_orientation_towards(std::span<const double, 3> a, std::span<const double, 3> b,
                              std::span<const double, 3> c, std::span<const double, 3> v) {
  return sign_of_determinant(exact_difference(b, a), exact_difference(c, a), exact(v));
}

}  // namespace hiac
