#pragma once

#include <cstddef>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Returns how many tuples a field at a location of a mesh has.
inline std::size_t tuple_count(const ZooMesh& mesh, FieldLocation location) {
  switch (location) {
    case FieldLocation::node:
      return mesh.node_count();
    case FieldLocation::cell:
      return mesh.cell_count();
    case FieldLocation::corner:
      break;
  }
  return mesh.nodes.size();
}

}  // namespace hiac
