#pragma once

#include <cstdint>
#include <vector>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// Keeps the last of several points that a deck defines under one number.
void keep_last_points(std::vector<std::int64_t>& numbers, std::vector<double>& xyz);

/// Keeps the last of several cells that a deck defines under one number. The arrays are those of
/// ForeignMesh.
void keep_last_cells(std::vector<std::int64_t>& numbers, std::vector<std::uint16_t>& cell_types,
                     std::vector<std::int64_t>& cell_nodes, const std::vector<ForeignType>& types);

}  // namespace hiac::formats
