#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/frame/projection.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// By which kernel a cell may be drawn. Cells that none is for, with planar faces or with curved
/// ones (has_curved_faces), are for render_general_cells.
enum class CellKernel : std::uint8_t { none_planar, none_curved, linear, quadratic, cubic };

/// For every cell the kernel for its kind, when it is a linear tetrahedron, or a quadratic or cubic
/// one with straight edges (edge_deviation at most `straightness`), with projectable corners, none
/// of whose faces is seen so nearly edge-on that its depth is decided by rounding.
std::vector<CellKernel> kernel_cells(const ZooMesh& mesh, std::span<const ProjectedNode> nodes,
                                     double straightness);

}  // namespace hiac
