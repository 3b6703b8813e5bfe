#pragma once

#include <array>
#include <cstdint>

#include "hiac/geometry/predicates.hpp"
#include "hiac/geometry/view.hpp"

namespace hiac {

/// Returns the exact side of the plane of a, b and c on which the eye is: +1 when the triangle runs
/// counter-clockwise as seen from the eye, 0 when it is seen edge-on. In an orthographic view the
/// eye is infinitely far away, against `direction`.
inline int eye_side(Point3 a, Point3 b, Point3 c, const View& view) {
  if (view.perspective) return orientation(a, b, c, Point3(view.eye));
  return -orientation_towards(a, b, c, Point3(view.direction));
}

/// eye_side() of the four faces of a tetrahedron (in the order of its shape's table), bit f for
/// face f. Terms that the faces share are computed once.
struct EyeSides {
  std::uint8_t positive = 0, negative = 0;
};
EyeSides eye_sides_of_tetrahedron(const std::array<const double*, 4>& corners, const View& view);

}  // namespace hiac
