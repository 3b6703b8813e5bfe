#pragma once

#include <array>
#include <cstdint>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// The cost of drawing a cell, relative to ten for a linear tetrahedron: the time that a ray takes
/// through one (docs/performance.md, "Cells of every kind", affine cells).
constexpr std::uint32_t cell_weight(CellKind kind) {
  constexpr std::array<std::uint8_t, kKindCount> kWeights{10, 16, 23,   // tetrahedron
                                                          37, 38, 41,   // pyramid
                                                          23, 33, 38,   // prism
                                                          34, 40, 45,   // wedge
                                                          26, 36, 40};  // brick
  return kWeights[static_cast<std::size_t>(kind)];
}

}  // namespace hiac
