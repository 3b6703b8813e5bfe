#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hiac/base/loop_crew.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/faces/face_numbering.hpp"

namespace hiac {

/// The sides of its shared faces on which a cell lies; bit f of each mask is the cell's face f.
struct CellSides {
  std::uint8_t positive = 0;   ///< the rest of the cell is on the positive side of the face's plane
  std::uint8_t negative = 0;   ///< ... on the negative side
  std::uint8_t unsettled = 0;  ///< shared with a cell that is not simply across it
  /// The position where plane_corners() starts, two bits per face, face 0 lowest.
  std::uint16_t plane_start = 0;

  /// The side of the face's plane on which the rest of the cell lies: +1, -1, or 0.
  [[nodiscard]] int side(std::size_t face) const {
    return static_cast<int>((positive >> face) & 1) - static_cast<int>((negative >> face) & 1);
  }
  [[nodiscard]] unsigned start(std::size_t face) const { return (plane_start >> (2 * face)) & 3U; }
};

/// A face without a neighbour, or a folded one, whose two cells lie on the same side of it; with
/// its plane_corners() and the side of their plane on which its cell lies.
struct UnmatchedFace {
  CellId cell;
  std::uint8_t face;            ///< its number within the cell
  std::array<NodeId, 4> nodes;  ///< a triangle repeats its last node
  std::uint8_t corner_count;    ///< 3 or 4; 3 also if two of four corners coincide
  std::int8_t side;             ///< side_of_cell(); 0 for a cell without volume
  double deviation;             ///< quadrilateral_deviation(); 0 for a triangle
};

/// A shared face whose arrows need both of its cells, for every view.
struct UnsettledFace {
  CellId cell;
  std::uint32_t face;
};

/// What the visibility orders of a mesh have in common, whatever the view: it is computed once and
/// serves any number of orders. About 22 bytes per tetrahedron, of which the adjacency takes 16.
struct OrderBasis {
  const ZooMesh* mesh;  ///< must outlive the basis
  FaceAdjacency adjacency;
  FaceNumbering faces;
  std::vector<CellSides> sides;          ///< of every cell
  std::vector<UnsettledFace> unsettled;  ///< by cell, then face
  std::vector<UnmatchedFace> unmatched;  ///< by cell, then face
  std::uint64_t shared_faces = 0;        ///< each counted once
  bool convex = false;                   ///< boundary_is_convex()
  /// Pairs of cells that have inner points in common, so that rays may meet either cell first.
  /// order_basis does not search for them, as most meshes have none; overlapping_cells in
  /// check/overlap.hpp does.
  std::vector<std::array<CellId, 2>> overlaps = {};
};

/// Decides by exact determinants on which side of each of its faces a cell lies, and whether the
/// two cells of every shared face lie on different sides of it.
///
/// Throws InputError when the adjacency is not mutual: when a cell names a neighbour more or less
/// often than the neighbour names it.
///
/// `crew`: processes that call it with the same mesh and share the work; null: this one alone.
OrderBasis order_basis(const ZooMesh& mesh, FaceAdjacency adjacency,
                       const LoopCrew* crew = nullptr);

}  // namespace hiac
