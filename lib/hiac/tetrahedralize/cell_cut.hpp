#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
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
/// into four or five, a prism into three, a pyramid into two. `names`: of the cell's corners, in an
/// order that all cells at a face agree on.
///
/// Every quadrilateral face is cut by the diagonal from its corner of the least name, so that the
/// two cells at a face cut it alike (J. Dompierre, P. Labbé, M.-G. Vallet, R. Camarero, "How to
/// subdivide pyramids, prisms and hexahedra into tetrahedra", 1999). The faces at the cell's corner
/// of the least name are then all cut through that corner, and the triangles of the other faces are
/// joined to it. In a convex cell with planar faces these tetrahedra fill the cell.
CellCut cut_cell(CellKind kind, std::span<const NodeId> names);

/// The quadrilateral faces of a cell, by number, that are cut by the diagonal which does not go
/// through their corner of the least name.
using OtherDiagonals = std::bitset<6>;

/// Joins the triangles of a cell's faces to a corner, except those of the faces at that corner;
/// nothing where one of these is not cut through it. To kCellCenter all triangles are joined.
std::optional<CellCut> cut_cell_at(std::uint8_t apex, CellKind kind, std::span<const NodeId> names,
                                   OtherDiagonals other);

}  // namespace hiac
