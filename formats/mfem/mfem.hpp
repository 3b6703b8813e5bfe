#pragma once

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// MFEM meshes, conforming and with hanging nodes, straight or with nodes of order 2 and 3 on
/// tetrahedra, and the grid function beside them: "a.mesh" with "a.gf", "refined.mesh" and
/// "displaced.mesh" with "sol.gf", as MFEM's examples name them. Functions: H1 up to order 3 on
/// tetrahedra and of order 1 on all cells, and L2 of order 0.
///
/// https://mfem.org/mesh-format-v1.0; degrees of freedom are numbered as in MFEM's class
/// H1_FECollection: vertices, then edges, then faces, the last two in the order in which the
/// elements first use them.
Format mfem_format();

}  // namespace hiac::formats
