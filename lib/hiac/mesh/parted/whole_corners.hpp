#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "hiac/mesh/cell_kind.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// No node of a mesh, and no corner of a face, which are different.
inline constexpr std::uint64_t kNoGlobalNode = std::numeric_limits<std::uint64_t>::max();
inline constexpr std::uint64_t kNoCorner = kNoGlobalNode - 1;

/// Returns the corners of a face of a part's cell by their numbers in the whole mesh, in the face's
/// own order; of a triangle the last is kNoCorner. `global_nodes`: of every node of the part.
inline std::array<std::uint64_t, 4> whole_corners(const ZooMesh& part,
                                                  std::span<const std::uint64_t> global_nodes,
                                                  CellId cell, std::size_t face) {
  std::array<std::uint64_t, 4> numbers;
  numbers.fill(kNoCorner);
  const ShapeFace& shape = topology_of(part.kinds[cell]).faces[face];
  for (std::size_t k = 0; k < shape.corner_count; ++k)
    numbers[k] = global_nodes[part.cell_nodes(cell)[shape.corners[k]]];
  return numbers;
}

}  // namespace hiac
