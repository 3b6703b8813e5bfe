#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hiac/check/conformity.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Returns the exact signs (-1, 0, 1) of the volumes that closed surfaces enclose; shell_of tells
/// the surface of every face, whose corners run counter-clockwise as seen from the mesh's outside.
/// A quadrilateral counts as the bilinear surface of its corners. Sums of doubles decide where
/// their error bound allows; the other shells are evaluated in CGAL's exact ring type.
std::vector<int> shell_volume_signs(const ZooMesh& mesh, std::span<const FreeFace> faces,
                                    std::span<const std::uint32_t> shell_of, std::size_t shells);

}  // namespace hiac
