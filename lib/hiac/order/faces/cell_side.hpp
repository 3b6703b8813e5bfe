#pragma once

#include <array>
#include <cstdint>

#include "hiac/geometry/predicates.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Where plane_corners begins to go round a face: the position in face.corners of the corner before
/// its second. 0 for a triangle.
unsigned plane_start(const ZooMesh& mesh, CellId cell, const ShapeFace& face);

/// A face's corners (numbers of its cell's nodes) in order around the face from `start` on. A
/// triangle repeats its last corner.
inline std::array<std::uint8_t, 4> corners_from(const ShapeFace& face, unsigned start) {
  const auto& c = face.corners;
  if (face.corner_count == 3) return {c[0], c[1], c[2], c[2]};
  return {c[start], c[(start + 1) % 4], c[(start + 2) % 4], c[(start + 3) % 4]};
}

/// A face's corners starting so that the first three span its plane: the corners around its lowest
/// node, or those around the opposite one where the former are nearly in line. Both cells that
/// share a face get the same three, one in the other's reverse order, so that they ask the same
/// questions of it.
inline std::array<std::uint8_t, 4> plane_corners(const ZooMesh& mesh, CellId cell,
                                                 const ShapeFace& face) {
  return corners_from(face, plane_start(mesh, cell, face));
}

/// The side of the plane of a face's plane_corners on which the rest of the cell lies: the sign of
/// the orientation of the first corner of the cell that is off the face and off the plane; 0 when
/// there is none (a cell without volume).
int side_of_cell(const ZooMesh& mesh, CellId cell, const std::array<std::uint8_t, 4>& plane);
/// The side of every face on which a cell lies that turns one way at all its corners, whether or
/// not its faces are planar: -1 for positively oriented cells (cell_kind.hpp), +1 for their mirror
/// images; 0 where corners turn both ways, or none does. Exact for the corners.
int side_of_all_faces(const ZooMesh& mesh, CellId cell);

/// The same for a cell of higher order, whose corners alone do not tell: by the sign of its
/// Jacobian determinant in its middle; 0 where that is not far from zero.
int side_by_jacobian(const ZooMesh& mesh, CellId cell);
inline int side_of_cell(const ZooMesh& mesh, CellId cell, const ShapeFace& face) {
  return side_of_cell(mesh, cell, plane_corners(mesh, cell, face));
}

}  // namespace hiac
