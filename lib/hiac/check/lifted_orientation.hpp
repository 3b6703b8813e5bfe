#pragma once

#include <array>

#include "hiac/geometry/predicates.hpp"

namespace hiac {

/// Exact sign of det[(b - a, l_b), (c - a, l_c), (d - a, l_d), (e - a, l_e)] with l_p = |p - a|^2,
/// finite coordinates as given: for a positive tetrahedron a, b, c, d +1 when e is outside of its
/// circumsphere, 0 on it, -1 inside.
///
/// A filter with the bound of J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and
/// Fast Robust Geometric Predicates", 1997, section 4.4 (insphere), then CGAL's exact ring type.
int outside_sphere(Point3 a, Point3 b, Point3 c, Point3 d, Point3 e);

/// The same with l_p = height of p - height of a: for a positive tetrahedron +1 when the lifted e
/// is above the affine function that has the heights of a, b, c, d there. Finite heights.
int lifted_orientation(const std::array<Point3, 5>& points, const std::array<double, 5>& heights);

}  // namespace hiac
