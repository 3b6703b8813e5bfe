#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "hiac/geometry/predicates.hpp"
#include "hiac/geometry/view.hpp"

namespace hiac {

/// A convex face as seen from the eye: a triangle, or a quadrilateral that counts as planar.
struct SeenFace {
  std::array<const double*, 4> corners;  ///< positions, in order around the face
  std::size_t count;                     ///< 3 or 4
  int winding;                           ///< +1: counter-clockwise as seen from the eye; -1

  [[nodiscard]] Point3 corner(std::size_t k) const { return Point3(corners[k % count], 3); }
};

/// Where edges a-b and c-d cross on the screen: -1 when a-b is nearer, +1 when c-d is, 0 when they
/// meet; nothing when they do not cross properly. Exact.
std::optional<int> nearer_edge(Point3 a, Point3 b, Point3 c, Point3 d, const View& view);

/// True when some viewing ray crosses the inner of both faces.
///
/// Exact: two convex polygons on the sphere of directions are apart when the great circle through
/// an edge of one of them has them on different sides or, if no hemisphere holds both, one through
/// a corner of each. The faces must not be seen edge-on.
bool projections_overlap(const SeenFace& f, const SeenFace& g, const View& view);

/// True when `f` is met before `g` by some ray that crosses both, or no later by all of them, given
/// that there are such rays: of faces that pierce each other, whichever is asked about first.
/// `slack` is the distance, world units, that g may lie in front of f and still count as touching
/// it, where the eye sees both from the same side; of faces that pierce each other by no more only
/// the one is first that is farther in front of the other where it is.
bool reached_first(const SeenFace& f, const SeenFace& g, const View& view, double slack);

}  // namespace hiac
