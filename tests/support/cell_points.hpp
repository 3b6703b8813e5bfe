#pragma once

#include <array>
#include <cstddef>

#include "hiac/mesh/cell_kind.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::test {

/// The reference coordinates of a place on a face, whose first corner has u = v = 0, its second
/// u = 1, and its last v = 1.
inline Position reference_on_face(CellKind kind, std::size_t face, double u, double v) {
  const ShapeFace& shape = topology_of(kind).faces[face];
  const auto reference = reference_nodes(kind);
  const auto corner = [&](std::size_t k) { return reference[shape.corners[k]]; };
  Position at;
  for (std::size_t c = 0; c < 3; ++c)
    at[c] = corner(0)[c] + u * (corner(1)[c] - corner(0)[c]) +
            v * (corner(shape.corner_count - 1U)[c] - corner(0)[c]);
  return at;
}

/// The position of a place in a cell, by the shape functions.
inline Position point_of_cell(const ZooMesh& mesh, CellId cell, const Position& reference) {
  const CellKind kind = mesh.kinds[cell];
  std::array<double, kMaxNodesPerCell> weights;
  shape_functions<double>(kind, reference, weights);
  Position p{};
  const auto nodes = mesh.cell_nodes(cell);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) p[c] += weights[k] * mesh.position(nodes[k])[c];
  return p;
}

}  // namespace hiac::test
