#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// For a corner of a shape, the corners at the other ends of its edges, in order around it:
/// counter-clockwise as seen from outside a positively oriented cell.
struct CornerFan {
  std::size_t count = 0;
  std::array<std::uint8_t, 4> neighbors{};
};

/// The fans of all corners of a shape.
using ShapeFans = std::array<CornerFan, 8>;

constexpr ShapeFans make_fans(CellShape shape) {
  ShapeFans fans{};
  for (std::size_t corner = 0; corner < topology_of(shape).corner_count; ++corner) {
    // each face at the corner leads from the neighbour after the corner to the one before it
    std::array<std::uint8_t, 8> next{};
    std::uint8_t start = 0;
    for (const ShapeFace& face : topology_of(shape).faces)
      for (std::size_t k = 0; k < face.corner_count; ++k) {
        if (face.corners[k] != corner) continue;
        start = face.corners[(k + 1) % face.corner_count];
        next[start] = face.corners[(k + face.corner_count - 1) % face.corner_count];
      }
    CornerFan& fan = fans[corner];
    std::uint8_t at = start;
    do {
      fan.neighbors[fan.count++] = at;
      at = next[at];
    } while (at != start);
  }
  return fans;
}

inline constexpr std::array<ShapeFans, kShapeCount> kCornerFans{
    make_fans(CellShape::tetrahedron), make_fans(CellShape::pyramid), make_fans(CellShape::prism),
    make_fans(CellShape::wedge), make_fans(CellShape::brick)};

constexpr const CornerFan& corner_fan(CellShape shape, std::size_t corner) {
  return kCornerFans[static_cast<std::size_t>(shape)][corner];
}

}  // namespace hiac
