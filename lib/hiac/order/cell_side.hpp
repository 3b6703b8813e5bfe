#pragma once

#include <array>
#include <cstdint>

#include "hiac/geometry/predicates.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A face's corners (numbers of its cell's nodes) in order around the face, starting so that the
/// first three span its plane: the corners around its lowest node, or those around the opposite one
/// where the former are nearly in line. Both cells that share a face get the same three, one in the
/// other's reverse order, so that they ask the same questions of it. A triangle repeats its last
/// corner.
std::array<std::uint8_t, 4> plane_corners(const ZooMesh& mesh, CellId cell, const ShapeFace& face);

/// The side of the plane of a face's plane_corners on which the rest of the cell lies: the sign of
/// the orientation of the first corner of the cell that is off the face and off the plane; 0 when
/// there is none (a cell without volume).
int side_of_cell(const ZooMesh& mesh, CellId cell, const ShapeFace& face);

}  // namespace hiac
