#pragma once

#include <span>

namespace hiac {

/// A point or vector of three coordinates, world units.
using Point3 = std::span<const double, 3>;

/// Exact sign (-1, 0, 1) of det[b - a, c - a, d - a] for the coordinates as given, whatever their
/// size (finite). Positive when, seen from d, the triangle a, b, c runs counter-clockwise.
///
/// A floating-point filter with the forward error bound of J. R. Shewchuk, "Adaptive Precision
/// Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997, section 4.3, decides
/// almost always; the rest is evaluated in CGAL's exact ring type.
int orientation(Point3 a, Point3 b, Point3 c, Point3 d);

/// Exact sign of det[b - a, c - a, v]: positive when the vector v points to the side from which
/// the triangle a, b, c runs counter-clockwise.
int orientation_towards(Point3 a, Point3 b, Point3 c, Point3 v);

}  // namespace hiac
