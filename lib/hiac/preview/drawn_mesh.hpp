#pragma once

#include <cstdint>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::preview {

/// What a preview of a mesh draws: linear tetrahedra.
struct DrawnMesh {
  ZooMesh mesh;
  std::uint64_t approximated = 0;  ///< cells that are no linear tetrahedra
  unsigned halvings = 0;           ///< how often the edges of their tetrahedra are halved
};

/// The mesh itself, whose arrays are shared, if all its cells are linear tetrahedra; otherwise
/// linear tetrahedra made by subdivide_cells, those of curved cells with edges halved `levels`
/// times. Throws what that throws.
DrawnMesh drawn_mesh(const ZooMesh& mesh, unsigned levels);

}  // namespace hiac::preview
