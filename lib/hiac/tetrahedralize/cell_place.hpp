#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A place in a cell: one of its nodes, or a point of its reference cell.
struct CellPlace {
  static constexpr std::uint8_t kNoNode = 0xFF;

  CellId cell;
  std::uint8_t node;         ///< its number in the cell; kNoNode: `xi` says where the place is
  std::array<double, 3> xi;  ///< reference coordinates
};

/// Returns the centre of a kind's reference cell: the mean of the corners.
std::array<double, 3> reference_center(CellKind kind);

/// Returns the place of a cell's centre.
CellPlace center_of(const ZooMesh& mesh, CellId cell);

/// Numbers of the nodes of cells: coordinates, or a field.
struct NodeValues {
  std::span<const double> values;  ///< tuples, component fastest
  std::size_t width;               ///< components of a tuple
  FieldLocation location;          ///< node, or corner: one tuple per entry of ZooMesh::nodes
};

/// Computes the tuple at a place: that of the node, or what the cell's shape functions make of its
/// nodes' tuples. `tuple` has `values.width` entries.
void evaluate(const ZooMesh& mesh, const NodeValues& values, const CellPlace& place,
              std::span<double> tuple);

/// Returns the world position of a place.
std::array<double, 3> position_of(const ZooMesh& mesh, const CellPlace& place);

}  // namespace hiac
