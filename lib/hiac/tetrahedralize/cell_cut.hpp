#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Stands for a node in the middle of a cell, where its map has the mean of its reference corners.
inline constexpr std::uint8_t kCellCenter = 0xFF;

/// A tetrahedron whose corners are corners of a cell, or its centre: their numbers in the cell, in
/// the order of a tetrahedron's nodes.
using CornerTetrahedron = std::array<std::uint8_t, 4>;

/// The tetrahedra that a cell is cut into: twelve at most.
struct CellCut {
  std::array<CornerTetrahedron, 12> tetrahedra{};
  std::size_t count = 0;

  /// A view: the cut has to outlive it.
  [[nodiscard]] std::span<const CornerTetrahedron> all() const& {
    return std::span(tetrahedra).first(count);
  }
  std::span<const CornerTetrahedron> all() const&& = delete;
};

/// Cuts a cell of any kind into tetrahedra that turn as the cell does: a brick into six, a wedge
/// into four or five, a prism into three, a pyramid into two. `nodes`: the cell's.
///
/// Every quadrilateral face is cut by the diagonal from its corner of the least node id, so that
/// the two cells at a face cut it alike (J. Dompierre, P. Labbé, M.-G. Vallet, R. Camarero, "How to
/// subdivide pyramids, prisms and hexahedra into tetrahedra", 1999). The faces at the cell's corner
/// of the least id are then all cut through that corner, and the triangles of the other faces are
/// joined to it. In a convex cell with planar faces these tetrahedra fill the cell.
CellCut cut_cell(CellKind kind, std::span<const NodeId> nodes);

/// Cuts the faces as cut_cell does, and joins all their triangles to the cell's centre: cells whose
/// faces are not planar, where cut_cell's tetrahedra may be turned inside out, are mostly filled.
CellCut cut_cell_at_center(CellKind kind, std::span<const NodeId> nodes);

}  // namespace hiac
