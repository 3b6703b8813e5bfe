#pragma once

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Returns a field of cells or corners at the nodes: the mean over the cells that hold the node,
/// each counted once, whatever its size. NaN at nodes that no cell holds. Throws UsageError if the
/// field is one of nodes.
Field node_average(const ZooMesh& mesh, const Field& field);

/// Returns a field of nodes or corners at the cells: the mean over all nodes of the cell. Throws
/// UsageError if the field is one of cells.
Field cell_average(const ZooMesh& mesh, const Field& field);

/// Returns a field's values at the corners of all cells (one tuple per entry of ZooMesh::nodes),
/// without a copy if it is a field of corners.
SharedArray<double> values_at_corners(const ZooMesh& mesh, const Field& field);

}  // namespace hiac
