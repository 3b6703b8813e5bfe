#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/frame/projection.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The kernel that may draw a cell. Cells without a kernel, with planar or with curved faces
/// (has_curved_faces), are drawn by render_general_cells.
enum class CellKernel : std::uint8_t { none_planar, none_curved, linear, quadratic, cubic };

/// The kernel of every cell. A cell has the kernel of its kind if it is a linear tetrahedron, or a
/// quadratic or cubic one with straight edges (edge_deviation at most `straightness`), its corners
/// are projectable, and no face is seen so nearly edge-on that rounding decides its depth.
std::vector<CellKernel> kernel_cells(const ZooMesh& mesh, std::span<const ProjectedNode> nodes,
                                     double straightness);

}  // namespace hiac
