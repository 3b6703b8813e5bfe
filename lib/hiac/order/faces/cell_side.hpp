#pragma once

#include <array>
#include <cstdint>

#include "hiac/geometry/predicates.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Returns the position in face.corners where plane_corners starts: that of the corner before the
/// one in the middle of its first three. 0 for a triangle.
unsigned plane_start(const ZooMesh& mesh, CellId cell, const ShapeFace& face);

/// Returns a face's corners (numbers within the cell) in order around the face, starting at
/// position `start`. A triangle repeats its last corner.
inline std::array<std::uint8_t, 4> corners_from(const ShapeFace& face, unsigned start) {
  const auto& c = face.corners;
  if (face.corner_count == 3) return {c[0], c[1], c[2], c[2]};
  return {c[start], c[(start + 1) % 4], c[(start + 2) % 4], c[(start + 3) % 4]};
}

/// Returns a face's corners such that the first three span its plane: the corners around its lowest
/// node or, if these are nearly in line, those around the opposite node. Both cells that share a
/// face get the same three corners, one in the other's reverse order, so that their answers agree.
inline std::array<std::uint8_t, 4> plane_corners(const ZooMesh& mesh, CellId cell,
                                                 const ShapeFace& face) {
  return corners_from(face, plane_start(mesh, cell, face));
}

/// Returns the side of the plane of a face's plane_corners on which the rest of the cell lies: the
/// orientation of the first corner of the cell that is neither on the face nor in the plane; 0 if
/// there is none (a cell without volume).
int side_of_cell(const ZooMesh& mesh, CellId cell, const std::array<std::uint8_t, 4>& plane);
/// Returns the side of all its faces on which a cell lies, planar or not, if its corners have the
/// same orientation: -1 for positively oriented cells (cell_kind.hpp), +1 for their mirror images.
/// Returns 0 if corners have both orientations, or none has one. Exact for the corners.
int side_of_all_faces(const ZooMesh& mesh, CellId cell);

/// Returns the same for a cell of higher order, where corners alone do not decide, from the sign of
/// its Jacobian determinant in its middle; 0 if that is close to zero.
int side_by_jacobian(const ZooMesh& mesh, CellId cell);
inline int side_of_cell(const ZooMesh& mesh, CellId cell, const ShapeFace& face) {
  return side_of_cell(mesh, cell, plane_corners(mesh, cell, face));
}

}  // namespace hiac
