#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/cell_kind.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {

/// A place on an edge of a mesh, whose nodes have numbers of one kind or another.
template <typename Number>
struct EdgePlace {
  std::array<Number, 2> edge;  ///< the edge's ends
  double along;                ///< the whole edge, from 0 to 1
  Number node;                 ///< an end that is near; another number than all nodes' if none is
};

/// Whether a face, by the numbers of its corners in their order (any of them again where there are
/// three), has both ends of the edge, or an end that the place is near.
template <typename Number>
bool lies_on_face(const std::array<Number, 4>& corners, const EdgePlace<Number>& place) {
  const auto has = [&](Number node) {
    return corners[0] == node || corners[1] == node || corners[2] == node || corners[3] == node;
  };
  return has(place.node) || (has(place.edge[0]) && has(place.edge[1]));
}

/// The reference coordinates of a place on an edge in a face of a cell on which it lies
/// (lies_on_face).
template <typename Number>
std::array<double, 3> reference_on(CellKind kind, std::size_t face,
                                   const std::array<Number, 4>& corners,
                                   const EdgePlace<Number>& place) {
  const ShapeFace& shape = topology_of(kind).faces[face];
  const auto reference = reference_nodes(kind);
  const auto corner = [&](Number node) -> std::optional<std::uint8_t> {
    for (std::size_t k = 0; k < shape.corner_count; ++k)
      if (corners[k] == node) return shape.corners[k];
    return std::nullopt;
  };
  const auto begin = corner(place.edge[0]), end = corner(place.edge[1]);
  if (begin && end) {
    std::array<double, 3> on;
    for (std::size_t c = 0; c < 3; ++c)
      on[c] = reference[*begin][c] + place.along * (reference[*end][c] - reference[*begin][c]);
    return on;
  }
  return reference[corner(place.node).value()];
}

}  // namespace hiac
