#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/render/projection.hpp"
#include "hiac/render/transfer_table.hpp"

namespace hiac {

/// A scalar field as cells read it: values with the transfer function's intervals beside them.
struct FrameField {
  SharedArray<double> values;
  std::vector<ScalarIntervals> intervals;
  FieldLocation location = FieldLocation::node;

  /// Where the value of a cell's corner is. `entry` is the corner's index into ZooMesh::nodes.
  [[nodiscard]] std::size_t index(CellId cell, std::uint64_t entry, NodeId node) const {
    if (location == FieldLocation::node) return node;
    return location == FieldLocation::cell ? cell : entry;
  }
};

/// Everything that does not change while one image is made. Shared by all tiles, read only.
struct Frame {
  const ZooMesh& mesh;
  const Projector& projector;
  std::vector<ProjectedNode> nodes;
  std::vector<std::uint8_t> kernel_cells;  ///< what kernel_cells() says
  OpticsTables optics;
  FrameField color, extinction;  ///< one and the same where optics.same_field
  /// Pixels with less transparency than this are finished.
  double least_transparency = 0;
  /// Segments may overlap the one before by this much of the ray parameter: rounding.
  double witness_tolerance = 0;
  double depth = 0;      ///< extent of the mesh in the ray parameter
  double tolerance = 0;  ///< absolute error allowed per pixel and channel

  [[nodiscard]] const FrameField& color_field() const {
    return optics.same_field ? extinction : color;
  }
};

}  // namespace hiac
