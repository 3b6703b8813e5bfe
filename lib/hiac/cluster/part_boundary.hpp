#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A part of a mesh, its number among all parts and, for every node, the number in the whole mesh.
struct NumberedPart {
  std::uint32_t number;
  const ZooMesh& mesh;
  std::span<const std::uint64_t> global_nodes;
};

/// For every node whether other parts may have it, too: whether a cell with it has a face that no
/// other cell of the part shares. Cells do not overlap, so those around a node that several parts
/// share do not surround it in any of them.
std::vector<bool> nodes_on_boundary(const ZooMesh& part);

}  // namespace hiac
