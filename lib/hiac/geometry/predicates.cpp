#include "hiac/geometry/predicates.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "hiac/base/rounding.hpp"
#include "hiac/geometry/exact_determinant.hpp"

namespace hiac {
namespace {

struct Filtered {
  double determinant;
  double permanent;
  double size;  // 1-norm of u
};

// Returns det[u, v, w] by cofactors, the same sum with absolute values, and the 1-norm of u.
Filtered determinant(const std::array<double, 3>& u, const std::array<double, 3>& v,
                     const std::array<double, 3>& w) {
  const double vw_x1 = v[1] * w[2], vw_x2 = v[2] * w[1];
  const double vw_y1 = v[2] * w[0], vw_y2 = v[0] * w[2];
  const double vw_z1 = v[0] * w[1], vw_z2 = v[1] * w[0];
  const double ux = std::abs(u[0]), uy = std::abs(u[1]), uz = std::abs(u[2]);
  return {u[0] * (vw_x1 - vw_x2) + u[1] * (vw_y1 - vw_y2) + u[2] * (vw_z1 - vw_z2),
          ux * (std::abs(vw_x1) + std::abs(vw_x2)) + uy * (std::abs(vw_y1) + std::abs(vw_y2)) +
              uz * (std::abs(vw_z1) + std::abs(vw_z2)),
          ux + uy + uz};
}

// Shewchuk's bound A for a determinant of rounded differences; eps is half an ulp of 1.
constexpr double kErrorBound = (7.0 + 56.0 * kUnit) * kUnit;
// That bound neglects underflow. Each product of components of v and w is then off by up to half a
// denormal number, which a component of u multiplies, and so is each outer product. The smallest
// normal number is a generous bound.
constexpr double kUnderflow = std::numeric_limits<double>::min();

// Returns the sign, or 2 when the filter cannot decide, as after overflow or with NaN.
int filtered_sign(const Filtered& f) {
  if (std::abs(f.determinant) > kErrorBound * f.permanent + kUnderflow * (f.size + 1))
    return f.determinant > 0 ? 1 : -1;
  return 2;
}

// Recognizes a zero that is common in meshes whose sides lie along the axes: three vectors whose
// components vanish in the same coordinate. A difference of doubles is 0 only when they are equal.
bool shares_zero_coordinate(const std::array<double, 3>& u, const std::array<double, 3>& v,
                            const std::array<double, 3>& w) {
  for (std::size_t c = 0; c < 3; ++c)
    if (u[c] == 0 && v[c] == 0 && w[c] == 0) return true;
  return false;
}

// Recognizes a zero that is common between neighbouring cells, which share corners.
bool coincide(Point3 a, Point3 b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

std::array<double, 3> difference(Point3 a, Point3 b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

}  // namespace

int orientation(Point3 a, Point3 b, Point3 c, Point3 d) {
  const auto u = difference(b, a), v = difference(c, a), w = difference(d, a);
  const int sign = filtered_sign(determinant(u, v, w));
  if (sign != 2) return sign;
  if (shares_zero_coordinate(u, v, w) || coincide(a, d) || coincide(b, d) || coincide(c, d) ||
      coincide(a, b) || coincide(a, c) || coincide(b, c))
    return 0;
  return exact_orientation(a, b, c, d);
}

int orientation_towards(Point3 a, Point3 b, Point3 c, Point3 v) {
  const auto u = difference(b, a), w = difference(c, a);
  const std::array<double, 3> towards{v[0], v[1], v[2]};
  const int sign = filtered_sign(determinant(u, w, towards));
  if (sign != 2) return sign;
  if (shares_zero_coordinate(u, w, towards) || coincide(a, b) || coincide(a, c) || coincide(b, c))
    return 0;
  return exact_orientation_towards(a, b, c, v);
}

}  // namespace hiac
