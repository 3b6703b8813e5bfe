#pragma once

#include <cstdint>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// One part of a parted mesh: some of its cells, with their nodes, as a mesh of its own, and the
/// numbers that these have in the whole mesh. Both arrays rise strictly, so that comparing local
/// numbers gives what comparing global ones gives.
///
/// A node that several parts share has the same global number, coordinates and values in all of
/// them. A face between two parts is unmatched in both.
struct MeshPart {
  ZooMesh mesh;
  SharedArray<std::uint64_t> global_nodes;  ///< for every node of `mesh` its number in the whole
  SharedArray<std::uint64_t> global_cells;  ///< for every cell of `mesh` its number in the whole
};

}  // namespace hiac
