#pragma once

#include <array>

#include "hiac/geometry/predicates.hpp"

namespace hiac {

/// Returns the exact sign of det[(b - a, l_b), (c - a, l_c), (d - a, l_d), (e - a, l_e)] with
/// l_p = |p - a|^2, for finite coordinates as given. If the tetrahedron a, b, c, d is positive, it
/// is +1 if e is outside its circumsphere, 0 on it, -1 inside.
///
/// A filter with the bound of J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and
/// Fast Robust Geometric Predicates", 1997, section 4.4 (insphere), is followed by CGAL's exact
/// ring type.
int outside_sphere(Point3 a, Point3 b, Point3 c, Point3 d, Point3 e);

/// Returns the same with l_p = height of p - height of a: if the tetrahedron is positive, +1 if the
/// lifted e is above the affine function with the heights of a, b, c, d there. Finite heights.
int lifted_orientation(const std::array<Point3, 5>& points, const std::array<double, 5>& heights);

}  // namespace hiac
