#pragma once

#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats::gmsh {

/// Writes MSH 4.1, binary, so that numbers are preserved to the last bit: one volume, nodes and
/// elements numbered from 1 in the mesh's order. Wedges are written as bricks with a repeated node.
/// Returns notes on what the format cannot hold. Throws InputError(path, ...).
std::vector<std::string> write_msh(const std::string& path, const ZooMesh& mesh);

}  // namespace hiac::formats::gmsh
