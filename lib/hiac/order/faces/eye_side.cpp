#include "hiac/order/faces/eye_side.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/cell_kind.hpp"

namespace hiac {
namespace {

Vector difference(const double* a, const double* b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
// Values whose signs are the sides of the eye, and a bound of their rounding errors. A determinant
// of three vectors has six products of three factors; every product is subject to at most three
// rounded differences, two multiplications and three additions, that is 8 eps of it to first order
// (eps: half an ulp of 1). Underflow adds less than the smallest normal number times the remaining
// factor.
struct Filtered {
  std::array<double, 4> values;
  double error;
};
constexpr double kEpsilon = std::numeric_limits<double>::epsilon() / 2;
constexpr double kDeterminantError = 6 * 10 * kEpsilon;
constexpr double kUnderflow = 8 * std::numeric_limits<double>::min();

// eye_side(a, b, c) = -sign det[a - e, b - e, c - e].
Filtered from_eye(const std::array<const double*, 4>& p, const double* eye) {
  const Vector r0 = difference(p[0], eye), r1 = difference(p[1], eye), r2 = difference(p[2], eye),
               r3 = difference(p[3], eye);
  const Vector r01 = cross(r0, r1), r23 = cross(r2, r3);
  const double size = std::max({largest(r0), largest(r1), largest(r2), largest(r3)});
  return {{-dot(r01, r3), -dot(r23, r1), dot(r23, r0), dot(r01, r2)},
          kDeterminantError * size * size * size + kUnderflow * (size + 1)};
}

// eye_side(a, b, c) = -sign det[b - a, c - a, v]; as seen along v, the three faces around the last
// corner cover what the first one covers the other way round.
Filtered along(const std::array<const double*, 4>& p, const Vector& v) {
  const Vector u0 = difference(p[0], p[3]), u1 = difference(p[1], p[3]),
               u2 = difference(p[2], p[3]);
  const double t01 = dot(u0, cross(u1, v)), t12 = dot(u1, cross(u2, v)),
               t20 = dot(u2, cross(u0, v));
  const double size = std::max({largest(u0), largest(u1), largest(u2)}), speed = largest(v);
  return {{-t01, -t12, -t20, t01 + t12 + t20},
          4 * kDeterminantError * size * size * speed + kUnderflow * (size + speed + 1)};
}

}  // namespace

EyeSides eye_sides_of_tetrahedron(const std::array<const double*, 4>& corners, const View& view) {
  const Filtered filtered =
      view.perspective ? from_eye(corners, view.eye.data()) : along(corners, view.direction);
  unsigned positive = 0, negative = 0;
  for (std::size_t f = 0; f < 4; ++f) {
    positive |= (filtered.values[f] > filtered.error ? 1U : 0U) << f;
    negative |= (filtered.values[f] < -filtered.error ? 1U : 0U) << f;
  }
  // NaN and overflow lead to the exact test as well
  for (unsigned left = ~(positive | negative) & 0xFU; left != 0; left &= left - 1) {
    const auto f = static_cast<unsigned>(std::countr_zero(left));
    const auto& c = shape_tables::kTetrahedronFaces[f].corners;
    const int side = eye_side(Point3(corners[c[0]], 3), Point3(corners[c[1]], 3),
                              Point3(corners[c[2]], 3), view);
    positive |= (side > 0 ? 1U : 0U) << f;
    negative |= (side < 0 ? 1U : 0U) << f;
  }
  return {static_cast<std::uint8_t>(positive), static_cast<std::uint8_t>(negative)};
}

}  // namespace hiac
