#pragma once

#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats::vtk {

/// Writes a mesh as .vtu, completely or not at all: every number as it is in memory, node and cell
/// fields, units, and metadata as data of the whole dataset. VTK has no cell for the wedges: they
/// are written as bricks with a repeated node, which read_vtu turns back into wedges. Returns notes
/// on that and on corner fields, which VTU cannot hold and which are left out. Throws InputError
/// naming the file for kinds that VTU cannot hold.
std::vector<std::string> write_vtu(const std::string& path, const ZooMesh& mesh);

}  // namespace hiac::formats::vtk
