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
  int winding;                           ///< +1: counter-clockwise as seen from the eye; else -1

  [[nodiscard]] Point3 corner(std::size_t k) const { return Point3(corners[k % count], 3); }
};

/// Compares edges a-b and c-d where they cross on the screen: -1 if a-b is nearer, +1 if c-d is, 0
/// if they meet; nothing if they do not cross properly. Exact.
std::optional<int> nearer_edge(Point3 a, Point3 b, Point3 c, Point3 d, const View& view);

/// Returns whether some viewing ray crosses the interiors of both faces.
///
/// Exact: two convex polygons on the sphere of directions are disjoint if the great circle through
/// an edge of one of them has them on different sides or, if no hemisphere contains both, one
/// through a corner of each. The faces must not be seen edge-on.
bool projections_overlap(const SeenFace& f, const SeenFace& g, const View& view);

/// Returns true if some ray that crosses both faces meets `f` before `g`, or if all of them meet
/// `f` no later; there must be such rays. Two faces that pierce each other are therefore each met
/// first. `slack` is the distance, in world units, by which g may lie in front of f and still count
/// as touching it, if the eye sees both from the same side. If faces pierce each other by no more
/// than that, only the one that lies farther in front of the other is first.
bool reached_first(const SeenFace& f, const SeenFace& g, const View& view, double slack);

}  // namespace hiac
