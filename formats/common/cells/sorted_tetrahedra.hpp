#pragma once

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// Numbers tetrahedra right-handed where their order says nothing of a hand: FEniCS sorts the nodes
/// of every cell by number, and so writes half of its tetrahedra in the mirror. That is taken to be
/// so where a mesh has 24 linear tetrahedra or more, all of them sorted, and of either hand; other
/// meshes stay as they are, since there a tetrahedron in the mirror is a defect to be seen. A note
/// tells how many were turned. Points have to be numbered from first_node on, and corner fields not
/// to be there yet.
void turn_sorted_tetrahedra(ForeignMesh& mesh);

}  // namespace hiac::formats
