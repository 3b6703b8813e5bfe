#pragma once

#include <cstdint>
#include <vector>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats {

/// Of points that decks tell several times under one number, keeps the last.
void keep_last_points(std::vector<std::int64_t>& numbers, std::vector<double>& xyz);

/// Of cells that decks tell several times under one number, keeps the last. The arrays are those of
/// ForeignMesh.
void keep_last_cells(std::vector<std::int64_t>& numbers, std::vector<std::uint16_t>& cell_types,
                     std::vector<std::int64_t>& cell_nodes, const std::vector<ForeignType>& types);

}  // namespace hiac::formats
