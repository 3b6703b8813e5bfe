#pragma once

#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/tetrahedralize/cell_cut.hpp"

namespace hiac {

/// Returns, for every cell, the quadrilateral faces that must be cut by their other diagonal so
/// that no cell has inverted tetrahedra; empty if there are none. Both cells at a face get the same
/// answer.
///
/// If a layer of cells is thinner than its faces are warped, opposite faces must be cut alike: a
/// cell whose cut (choose_cut) is bad gets another diagonal in a face that repairs it, and so do
/// the cells behind that face in turn, until one stays sound or the mesh ends. A cell that no such
/// chain of changes repairs keeps its cut.
std::vector<OtherDiagonals> choose_diagonals(const ZooMesh& mesh);

}  // namespace hiac
