#pragma once

#include "hiac/geometry/predicates.hpp"
#include "hiac/geometry/view.hpp"

namespace hiac {

/// The side of the plane of a, b, c on which the eye lies, exactly: +1 where the triangle is seen
/// counter-clockwise, 0 in its plane. In a parallel view the eye is infinitely far against the
/// direction. As well the side of the plane through the eye, a and b on which c is seen: +1 to the
/// left of the edge a -> b.
inline int eye_side(Point3 a, Point3 b, Point3 c, const View& view) {
  if (view.perspective) return orientation(a, b, c, Point3(view.eye));
  return -orientation_towards(a, b, c, Point3(view.direction));
}

}  // namespace hiac
