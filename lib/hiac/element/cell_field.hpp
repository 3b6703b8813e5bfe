#pragma once

#include <array>
#include <memory>

#include "hiac/element/field_values.hpp"
#include "hiac/element/world_polynomial.hpp"
#include "hiac/geometry/inverse_map.hpp"
#include "hiac/mesh/interpolant_range.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// One scalar field in one cell: its values at the nodes, the range of its interpolant
/// (interpolant_range.hpp), and the required accuracy.
struct CellField {
  std::array<double, kMaxNodesPerCell> values;
  double least, most;
  double allowed = 0;  ///< allowed absolute error of the field
  /// If set, it replaces the isoparametric interpolant. Shared, because fields are copied, and most
  /// have none.
  std::shared_ptr<const WorldPolynomial> polynomial;
};

/// A field in a cell, minus `level`. A polynomial that the nodes do not determine is replaced by a
/// constant; check_renderable refuses such cells beforehand.
CellField cell_field(const ZooMesh& mesh, CellId cell, const FieldValues& field, double level = 0);

/// The positions of a cell's nodes; entries beyond them are not set.
std::array<CellMap::Point, CellMap::kMostNodes> cell_positions(const ZooMesh& mesh, CellId cell);

}  // namespace hiac
