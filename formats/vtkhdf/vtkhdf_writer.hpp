#pragma once

#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats {

/// Writes a mesh as VTKHDF (version 1.0 of its file format, with a time 2.0), completely or not at
/// all: every number as it is in memory, node and cell fields, and the time as its one step. Wedges
/// are written as bricks with a repeated node. Returns notes on what the format cannot hold: corner
/// fields, units, other metadata, and the character / in the names of fields. Throws
/// InputError(path, ...).
std::vector<std::string> write_vtkhdf(const std::string& path, const ZooMesh& mesh);

}  // namespace hiac::formats
