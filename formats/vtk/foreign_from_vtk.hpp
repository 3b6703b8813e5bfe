#pragma once

#include <string>

#include "formats/common/mesh/foreign_mesh.hpp"

class vtkDataSet;

namespace hiac::formats::vtk {

/// Whether there are volume cells that no kind of the zoo is: of higher orders, with nodes in faces
/// or inside, polyhedra. Throws
/// InputError(subject, ...) when its arrays do not fit.
bool has_cells_beyond_the_zoo(vtkDataSet& dataset, const std::string& subject);

/// What a dataset holds, for such cells to be turned into others. Its fields are moved out of it.
/// Throws InputError(subject, ...) when its arrays do not fit.
ForeignMesh foreign_from_vtk(vtkDataSet& dataset, const std::string& subject);

}  // namespace hiac::formats::vtk
