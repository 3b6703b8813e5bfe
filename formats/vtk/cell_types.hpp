#pragma once

#include <cstddef>
#include <string>

#include "formats/common/cells/cell_conversion.hpp"

namespace hiac::formats::vtk {

/// How a cell of VTK type `type` with `nodes` nodes is converted. Node orders: see kTypes. If a
/// cell of a linear type has as many nodes as a quadratic one, the further nodes are ignored, as in
/// VTK.
CellConversion conversion_of(int type, std::size_t nodes);

/// VTK's name of a cell type without its prefix: "Tetra", "QuadraticHexahedron", ...
std::string cell_type_name(int type);

}  // namespace hiac::formats::vtk
