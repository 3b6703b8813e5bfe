#pragma once

#include <cstdint>
#include <vector>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// Where a deck defines several points under one number, keeps the last of them.
void keep_last_points(std::vector<std::int64_t>& numbers, std::vector<double>& xyz);

/// Where a deck defines several cells under one number, keeps the last of them. The arrays are
/// those of ForeignMesh.
void keep_last_cells(std::vector<std::int64_t>& numbers, std::vector<std::uint16_t>& cell_types,
                     std::vector<std::int64_t>& cell_nodes, const std::vector<ForeignType>& types);

}  // namespace hiac::formats
