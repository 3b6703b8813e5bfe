#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// The nodes (numbers within the cell) between the corners of a face: those of its edges, in order
/// around it, then its centre if the kind has one.
struct BetweenNodes {
  std::size_t count = 0;
  std::array<std::uint8_t, 9> nodes{};
};

/// Returns the nodes between the corners of face number `face` of a kind.
constexpr BetweenNodes nodes_between(CellKind kind, std::size_t face) {
  const ShapeTopology& shape = topology_of(kind);
  const std::size_t per_edge = static_cast<std::size_t>(order_of(kind)) - 1;
  const ShapeFace& of = shape.faces[face];
  BetweenNodes between;
  for (std::size_t k = 0; k < of.corner_count; ++k) {
    const std::uint8_t from = of.corners[k], to = of.corners[(k + 1) % of.corner_count];
    for (std::size_t e = 0; e < shape.edges.size(); ++e) {
      const auto [low, high] = shape.edges[e];
      if (!((low == from && high == to) || (low == to && high == from))) continue;
      for (std::size_t i = 0; i < per_edge; ++i) {
        const std::size_t along = low == from ? i : per_edge - 1 - i;
        between.nodes[between.count++] =
            static_cast<std::uint8_t>(shape.corner_count + e * per_edge + along);
      }
    }
  }
  if (kind == CellKind::tetrahedron20)
    between.nodes[between.count++] =
        static_cast<std::uint8_t>(shape.corner_count + per_edge * shape.edges.size() + face);
  return between;
}

}  // namespace hiac
