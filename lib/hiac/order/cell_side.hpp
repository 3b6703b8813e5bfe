#pragma once

#include <span>

#include "hiac/geometry/predicates.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The side of the plane of a face's first three corners on which the rest of the cell lies: the
/// sign of the orientation of the first corner of the cell that is off the face and off the plane;
/// 0 when there is none (a cell without volume).
int side_of_cell(const ZooMesh& mesh, CellId cell, const ShapeFace& face);

}  // namespace hiac
