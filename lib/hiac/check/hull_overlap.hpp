#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hiac/geometry/predicates.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The convex hull of the corners of a cell or a face. The triples include three corners of each of
/// its planes, and the pairs the ends of each of its edges, as far as these belong to the cell's
/// shape (the corner triangles and the diagonals of its quadrilaterals included).
struct Hull {
  std::array<const double*, 8> corners{};
  std::size_t count = 0;
  std::span<const std::array<std::uint8_t, 3>> triples;
  std::span<const std::array<std::uint8_t, 2>> pairs;

  [[nodiscard]] Point3 at(std::size_t k) const { return Point3(corners[k], 3); }
};

Hull hull_of_cell(const ZooMesh& mesh, CellId cell);
Hull hull_of_face(const ZooMesh& mesh, CellId cell, std::size_t face);

/// Returns true if a plane through corners of the hulls has the two hulls on different sides, by
/// exact determinants: then their interiors have no point in common. (Some but not all of a hull's
/// corners may lie on the plane.)
///
/// For convex polyhedra with planar faces the converse holds as well. Move a separating plane until
/// it meets a corner of each, and rotate it about the line through both until it meets a third: it
/// then contains a face of one of them, or an edge of one and a corner of the other. All planes of
/// these two kinds are tried.
bool are_separated(const Hull& p, const Hull& q);

/// Returns the largest gap between the hulls along the normal of a plane that is parallel to a face
/// of either or to an edge of each, in world units; if they overlap, minus their overlap_depth. The
/// rounding error is below a billionth of their sizes.
double gap_between(const Hull& p, const Hull& q);

/// Returns how deeply two hulls overlap, in world units: the least distance by which one must be
/// moved so that a plane parallel to a face of either, or to an edge of each, separates them.
/// Rounded.
inline double overlap_depth(const Hull& p, const Hull& q) {
  return std::max(0.0, -gap_between(p, q));
}

/// Searches for a point that lies strictly inside all corner triangles of the faces of both cells;
/// returns none if the search fails.
///
/// Such a point is inside both cells, whether or not their faces are planar: as seen from it, the
/// four corner triangles of a bilinear face P(u,v) have the right orientation, and so has the whole
/// face ((P - x).(P_u x P_v) is bilinear in u, v); the cell's surface therefore encloses the point.
/// The point's distance from the planes of p and q is at least `away_p` and `away_q`. `turn_p`,
/// `turn_q`: +1 for a cell whose faces run counter-clockwise as seen from outside, -1 for its
/// mirror image.
std::optional<std::array<double, 3>> common_point(const Hull& p, int turn_p, double away_p,
                                                  const Hull& q, int turn_q, double away_q);

}  // namespace hiac
