#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A hash of 128 bits of a mesh's kinds, nodes and coordinates, without its fields: that of all
/// time steps whose geometry is the same. Written as 32 hexadecimal digits.
std::string geometry_hash(const ZooMesh& mesh);

/// The same of the global numbers of a part's nodes and cells (parted/mesh_part.hpp).
std::string numbers_hash(std::span<const std::uint64_t> nodes,
                         std::span<const std::uint64_t> cells);

}  // namespace hiac
