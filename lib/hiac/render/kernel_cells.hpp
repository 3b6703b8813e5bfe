#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/render/projection.hpp"

namespace hiac {

/// For every cell, 1 when the tetrahedron kernel may draw it: a linear tetrahedron with projectable
/// nodes, none of whose faces is seen so nearly edge-on that its depth is decided by rounding. The
/// others are for render_general_cells.
std::vector<std::uint8_t> kernel_cells(const ZooMesh& mesh, std::span<const ProjectedNode> nodes);

}  // namespace hiac
