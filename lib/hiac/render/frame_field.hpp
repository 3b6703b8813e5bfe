#pragma once

#include <cstdint>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/render/transfer_table.hpp"

namespace hiac {

/// A scalar field as cells read it: values, and beside them the transfer function's intervals where
/// the field has one.
struct FrameField {
  SharedArray<double> values;
  std::vector<ScalarIntervals> intervals;
  FieldLocation location = FieldLocation::node;
  bool polynomial = false;  ///< interpolated by WorldPolynomial, else isoparametrically

  /// Where the value of a cell's corner is. `entry` is the corner's index into ZooMesh::nodes.
  [[nodiscard]] std::size_t index(CellId cell, std::uint64_t entry, NodeId node) const {
    if (location == FieldLocation::node) return node;
    return location == FieldLocation::cell ? cell : entry;
  }
};

}  // namespace hiac
