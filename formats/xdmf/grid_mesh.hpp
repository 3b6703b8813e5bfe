#pragma once

#include "formats/common/mesh/foreign_mesh.hpp"
#include "formats/xdmf/data_items.hpp"
#include "formats/xdmf/grids.hpp"

namespace hiac::formats::xdmf {

/// Appends the points and cells of a grid, structured or not, to `mesh`, and counts them in the
/// grid. Throws InputError naming the file and the element.
void add_grid_mesh(DataItems& items, UniformGrid& grid, ForeignMesh& mesh);

}  // namespace hiac::formats::xdmf
