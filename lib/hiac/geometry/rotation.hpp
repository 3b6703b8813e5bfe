#pragma once

#include <cmath>
#include <numbers>

#include "hiac/geometry/vector.hpp"

namespace hiac {

/// Cosine and sine of an angle.
struct Turn {
  double cosine, sine;
};

/// Of an angle in degrees: exact for multiples of 90.
inline Turn turn_by(double degrees) {
  int quarters = 0;
  const double rest = std::remquo(degrees, 90.0, &quarters) * std::numbers::pi / 180;
  const double c = std::cos(rest), s = std::sin(rest);
  switch (static_cast<unsigned>(quarters) % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

/// Rotates v about a unit axis, counter-clockwise as seen from the axis' tip, by O. Rodrigues'
/// formula.
inline Vector turned(const Vector& v, const Vector& axis, const Turn& turn) {
  const Vector across = cross(axis, v);
  const double along = dot(axis, v) * (1 - turn.cosine);
  Vector result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = turn.cosine * v[i] + turn.sine * across[i] + along * axis[i];
  return result;
}

}  // namespace hiac
