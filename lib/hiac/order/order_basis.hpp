#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/faces/face_numbering.hpp"

namespace hiac {

/// How a cell lies to its shared faces; bit f of each mask is the cell's face f.
struct CellSides {
  std::uint8_t positive = 0;   ///< the rest of the cell is on the positive side of the face's plane
  std::uint8_t negative = 0;   ///< ... on the negative side
  std::uint8_t unsettled = 0;  ///< shared with a cell that is not just on the other side of it
  /// Where plane_corners() begins, two bits a face, face 0 lowest.
  std::uint16_t plane_start = 0;

  /// The side of the face's plane on which the rest of the cell is: +1, -1, or 0.
  [[nodiscard]] int side(std::size_t face) const {
    return static_cast<int>((positive >> face) & 1) - static_cast<int>((negative >> face) & 1);
  }
  [[nodiscard]] unsigned start(std::size_t face) const { return (plane_start >> (2 * face)) & 3U; }
};

/// A face without neighbour, or folded: shared with a cell on the same side of it. Its
/// plane_corners() and how its cell lies to them.
struct UnmatchedFace {
  CellId cell;
  std::uint8_t face;            ///< of the cell
  std::array<NodeId, 4> nodes;  ///< a triangle repeats its last one
  std::uint8_t corner_count;    ///< 3 or 4; 3 where two of four corners are at one place
  std::int8_t side;             ///< side_of_cell(); 0 for a cell without volume
  double deviation;             ///< quadrilateral_deviation(); 0 for a triangle
};

/// A shared face that is asked from both sides for every view.
struct UnsettledFace {
  CellId cell;
  std::uint32_t face;
};

/// What visibility orders of a mesh rest on, whatever the view: made once, it serves any number of
/// them. About 22 bytes a tetrahedron, 16 of which are the adjacency.
struct OrderBasis {
  const ZooMesh* mesh;  ///< has to outlive the basis
  FaceAdjacency adjacency;
  FaceNumbering faces;
  std::vector<CellSides> sides;          ///< of every cell
  std::vector<UnsettledFace> unsettled;  ///< by cell, then face
  std::vector<UnmatchedFace> unmatched;  ///< by cell, then face
  std::uint64_t shared_faces = 0;        ///< each counted once
  bool convex = false;                   ///< boundary_is_convex()
  /// Pairs of cells that have inner points in common: rays meet either one first. order_basis does
  /// not look for them (overlapping_cells in check/overlap.hpp does), as most meshes have none.
  std::vector<std::array<CellId, 2>> overlaps = {};
};

/// Decides by exact determinants on which side of each of its faces a cell lies, and whether the
/// two cells of every shared face lie on either side of it.
///
/// Throws InputError when the adjacency is not mutual: when a cell names a neighbour that does not
/// name it back as often.
OrderBasis order_basis(const ZooMesh& mesh, FaceAdjacency adjacency);

}  // namespace hiac
