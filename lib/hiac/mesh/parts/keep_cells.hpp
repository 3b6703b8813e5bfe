#pragma once

#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Returns for every cell whether all of the field's values that belong to it, those at its nodes
/// or its own, lie from `low` to `high`, both included; NaN lies nowhere. The values stored decide,
/// not what is interpolated between them. Throws UsageError if the field has several components.
std::vector<bool> cells_within(const ZooMesh& mesh, const Field& field, double low, double high);

/// Returns the mesh of the cells that `keep` marks, in their order, with the nodes that these use,
/// in theirs, and the values of both. The adjacency is omitted and must be computed again.
ZooMesh keep_cells(const ZooMesh& mesh, const std::vector<bool>& keep);

}  // namespace hiac
