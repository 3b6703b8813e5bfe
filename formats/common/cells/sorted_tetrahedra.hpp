#pragma once

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// Numbers tetrahedra right-handed when their node order carries no orientation: FEniCS sorts the
/// nodes of every cell by number, so that half of its tetrahedra are mirrored. This is assumed when
/// a mesh has at least 24 linear tetrahedra, all sorted, and of both hands. Other meshes stay as
/// they are, because a mirrored tetrahedron is a defect there. A note says how many tetrahedra were
/// renumbered. Points must be numbered from first_node on, and there must be no corner fields yet.
void turn_sorted_tetrahedra(ForeignMesh& mesh);

}  // namespace hiac::formats
