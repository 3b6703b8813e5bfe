#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The surface of a linear cell as triangles, with the corners numbered by ascending node id. All
/// cells around an edge or a face share this order: a result computed for an edge or a triangle
/// from its corners in ascending order is the same, to the bit, in every cell that has it.
///
/// Quadrilateral faces are two triangles, split along the diagonal through their smallest node id.
struct CellSurface {
  static constexpr std::size_t kMostCorners = 8, kMostEdges = 18, kMostTriangles = 12;

  struct Triangle {
    std::array<std::uint8_t, 3> corners;  ///< ascending
    std::array<std::uint8_t, 3> edges;    ///< (0,1), (0,2), (1,2) of its corners
    std::uint8_t face;  ///< the cell's face that it is part of: index into the kind's faces
  };

  std::size_t corner_count = 0, edge_count = 0, triangle_count = 0;
  std::array<NodeId, kMostCorners> nodes;                     ///< ascending
  std::array<std::uint8_t, kMostCorners> ranks;               ///< of the kind's corners in `nodes`
  std::array<std::array<std::uint8_t, 2>, kMostEdges> edges;  ///< corners, ascending
  std::array<Triangle, kMostTriangles> triangles;

  /// The edge between two corners, which must be connected by one.
  [[nodiscard]] std::uint8_t edge_between(std::uint8_t a, std::uint8_t b) const {
    const auto low = std::min(a, b), high = std::max(a, b);
    std::uint8_t e = 0;
    while (edges[e][0] != low || edges[e][1] != high) ++e;
    return e;
  }
};

/// The surface of a cell. `nodes`: the cell's nodes in their conventional order.
CellSurface cell_surface(CellKind kind, std::span<const NodeId> nodes);

}  // namespace hiac
