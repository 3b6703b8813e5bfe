#pragma once

#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/tetrahedralize/cell_cut.hpp"

namespace hiac {

/// Which quadrilateral faces have to be cut by their other diagonal for no cell's tetrahedra to be
/// turned inside out, for every cell; empty where no face has to. Both cells at a face are told the
/// same.
///
/// Where a layer of cells is thinner than its faces are warped, opposite faces have to be cut
/// alike: a cell whose cut (choose_cut) is bad gets another diagonal in a face that mends it, and
/// the cells behind that face in turn, until one stays sound or the mesh ends. A cell that no such
/// row of changes mends keeps the cut it had.
std::vector<OtherDiagonals> choose_diagonals(const ZooMesh& mesh);

}  // namespace hiac
