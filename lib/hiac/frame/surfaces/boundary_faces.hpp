#pragma once

#include <cstdint>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The mesh's boundary: for every cell a bit for each of its faces that no other cell has, or that
/// more than two cells have (FaceAdjacency).
std::vector<std::uint8_t> boundary_faces(const ZooMesh& mesh);

}  // namespace hiac
