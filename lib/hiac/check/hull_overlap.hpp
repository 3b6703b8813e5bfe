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

/// The convex hull of a cell's corners, or of a face's, by what spans it: among the triples are
/// three corners of every one of its planes, among the pairs the ends of every one of its edges, as
/// far as they are those of the cell's shape (the corner triangles and the diagonals of its
/// quadrilaterals included).
struct Hull {
  std::array<const double*, 8> corners{};
  std::size_t count = 0;
  std::span<const std::array<std::uint8_t, 3>> triples;
  std::span<const std::array<std::uint8_t, 2>> pairs;

  [[nodiscard]] Point3 at(std::size_t k) const { return Point3(corners[k], 3); }
};

Hull hull_of_cell(const ZooMesh& mesh, CellId cell);
Hull hull_of_face(const ZooMesh& mesh, CellId cell, std::size_t face);

/// True when a plane through corners of the hulls has one of them on one side of it and the other
/// on the other side, by exact determinants: then their interiors have no point in common. (Corners
/// may lie on the plane, but not all of a hull's.)
///
/// For convex polyhedra with planar faces the converse holds as well. Move a plane that separates
/// them until it meets a corner of each, and turn it about the line through both until it meets a
/// third: it then holds a face of one of them, or an edge of one and a corner of the other. All
/// planes of these two kinds are tried.
bool are_separated(const Hull& p, const Hull& q);

/// The largest distance that a plane parallel to a face of either hull, or to an edge of each, puts
/// between them, world units; negative, their overlap_depth, where they overlap. Rounded, by less
/// than a billionth of their sizes.
double gap_between(const Hull& p, const Hull& q);

/// How deep two hulls reach into one another, world units: the least distance by which one has to
/// be moved for a plane of either, or across an edge of each, to come between them. Rounded.
inline double overlap_depth(const Hull& p, const Hull& q) {
  return std::max(0.0, -gap_between(p, q));
}

/// A point that lies strictly inside of all corner triangles of the faces of both cells, or none
/// where the search for it gave up.
///
/// Such a point is inside of both cells, whether their faces are planar or not: seen from it the
/// four corner triangles of a bilinear face P(u,v) run the right way round, and with them all of
/// the face ((P - x).(P_u x P_v) is bilinear in u, v), so that the cell's surface goes around the
/// point. It has to keep `away_p`, `away_q` from all planes of p, of q. `turn_p`, `turn_q`: +1 for
/// a cell whose faces run counter-clockwise as seen from outside, -1 for its mirror image.
std::optional<std::array<double, 3>> common_point(const Hull& p, int turn_p, double away_p,
                                                  const Hull& q, int turn_q, double away_q);

}  // namespace hiac
