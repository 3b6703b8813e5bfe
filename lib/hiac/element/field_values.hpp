#pragma once

#include <cstddef>
#include <cstdint>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A scalar field of a mesh: its values, where they are, and how cells interpolate them.
struct FieldValues {
  SharedArray<double> values;
  FieldLocation location = FieldLocation::node;
  bool polynomial = false;  ///< interpolated by WorldPolynomial, else isoparametrically

  /// The index of the value at a cell's corner. `entry` is the corner's index into ZooMesh::nodes.
  [[nodiscard]] std::size_t index(CellId cell, std::uint64_t entry, NodeId node) const {
    if (location == FieldLocation::node) return node;
    return location == FieldLocation::cell ? cell : entry;
  }
};

}  // namespace hiac
