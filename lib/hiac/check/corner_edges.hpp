#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// A corner where three edges of a shape meet, and the corners at their other ends:
/// det[a - corner, b - corner, c - corner] > 0 for a positively oriented cell. Times a constant it
/// is the Jacobian of a linear cell's map at that corner (at a pyramid's or a wedge's, in the limit
/// along the edges).
struct CornerEdges {
  std::uint8_t corner, a, b, c;
};

struct ShapeCornerEdges {
  std::size_t count = 0;
  std::array<CornerEdges, 8> corners{};
};

/// All such corners of a shape: all but a pyramid's apex and a wedge's node 6.
constexpr ShapeCornerEdges corner_edges_of(const ShapeTopology& shape) {
  ShapeCornerEdges all;
  for (std::uint8_t corner = 0; corner < shape.corner_count; ++corner) {
    // a face that runs counter-clockwise through before, corner, after: `before` follows `after`
    // when one goes around the corner clockwise
    std::array<std::uint8_t, 8> follows{};
    std::size_t faces = 0;
    std::uint8_t first = 0;
    for (const ShapeFace& face : shape.faces)
      for (std::size_t k = 0; k < face.corner_count; ++k) {
        if (face.corners[k] != corner) continue;
        first = face.corners[(k + 1) % face.corner_count];
        follows[first] = face.corners[(k + face.corner_count - 1) % face.corner_count];
        ++faces;
      }
    if (faces != 3) continue;
    const std::uint8_t second = follows[first], third = follows[second];
    all.corners[all.count++] = {corner, third, second, first};
  }
  return all;
}

/// The same of every shape, as a table.
inline constexpr std::array<ShapeCornerEdges, kShapeCount> kCornerEdges = [] {
  std::array<ShapeCornerEdges, kShapeCount> table{};
  for (std::size_t s = 0; s < kShapeCount; ++s)
    table[s] = corner_edges_of(topology_of(static_cast<CellShape>(s)));
  return table;
}();

}  // namespace hiac
