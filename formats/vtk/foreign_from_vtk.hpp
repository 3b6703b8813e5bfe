#pragma once

#include <string>

#include "formats/common/mesh/foreign_mesh.hpp"

class vtkDataSet;

namespace hiac::formats::vtk {

/// Whether there are volume cells that the zoo has no kind for: cells of higher orders, with nodes
/// in faces or inside, and polyhedra. Throws InputError(subject, ...) when the dataset's arrays do
/// not fit.
bool has_cells_beyond_the_zoo(vtkDataSet& dataset, const std::string& subject);

/// The contents of a dataset, so that such cells can be converted. Its fields are moved out of it.
/// Throws InputError(subject, ...) when its arrays do not fit.
ForeignMesh foreign_from_vtk(vtkDataSet& dataset, const std::string& subject);

}  // namespace hiac::formats::vtk
