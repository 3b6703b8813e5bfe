#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Denotes a node in the middle of a cell, the image of the mean of its reference corners.
inline constexpr std::uint8_t kCellCenter = 0xFF;

/// A tetrahedron between corners of a cell or its centre: their numbers in the cell, in the order
/// of a tetrahedron's nodes.
using CornerTetrahedron = std::array<std::uint8_t, 4>;

/// The tetrahedra into which a cell is cut: at most twelve.
struct CellCut {
  std::array<CornerTetrahedron, 12> tetrahedra{};
  std::size_t count = 0;

  /// Returns a view: the cut must outlive it.
  [[nodiscard]] std::span<const CornerTetrahedron> all() const& {
    return std::span(tetrahedra).first(count);
  }
  std::span<const CornerTetrahedron> all() const&& = delete;
};

/// Cuts a cell of any kind into tetrahedra with the cell's orientation: a brick into six, a wedge
/// into four or five, a prism into three, a pyramid into two. `names` orders the cell's corners in
/// a way on which all cells at a face agree.
///
/// Every quadrilateral face is cut by the diagonal from its corner of least name, so that the two
/// cells at a face cut it alike (J. Dompierre, P. Labbé, M.-G. Vallet, R. Camarero, "How to
/// subdivide pyramids, prisms and hexahedra into tetrahedra", 1999). The faces at the cell's corner
/// of least name are thus all cut through that corner, and the triangles of the other faces are
/// joined to it. In a convex cell with planar faces these tetrahedra fill the cell.
CellCut cut_cell(CellKind kind, std::span<const NodeId> names);

/// The quadrilateral faces of a cell, by number, that are cut by the diagonal which does not pass
/// through their corner of least name.
using OtherDiagonals = std::bitset<6>;

/// Joins the triangles of a cell's faces to a corner, except those of the faces at that corner;
/// returns nothing if one of these faces is not cut through it. With kCellCenter, all triangles are
/// joined to the centre.
std::optional<CellCut> cut_cell_at(std::uint8_t apex, CellKind kind, std::span<const NodeId> names,
                                   OtherDiagonals other);

}  // namespace hiac
