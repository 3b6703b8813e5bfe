#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hiac/check/cells.hpp"
#include "hiac/check/defect.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/faces/face_numbering.hpp"

namespace hiac {

/// How the cells of a mesh fit together, across their faces:
///
/// - adjacency: the mesh brings neighbours other than `adjacency`, which build_face_adjacency made;
/// - overshared_face: three cells or more have a face with the same corners (named by cell);
/// - folded_face: two cells lie on the same side of their common face, as far as their turns tell,
///   or have its four corners in different order around it: their interiors overlap next to it;
/// - torn_interface, hanging_interface, sliding_interface: a face without neighbour that lies on
///   others of other cells, which are on its other side: on one with its corners' places (but other
///   nodes), on parts of it or within a larger one, or neither. A face has the first of these that
///   fits.
///
/// Faces lie on one another when they do so to within `planarity` times their size, and their own
/// deviations from planes; with planarity = 0 by exact determinants.
std::vector<Finding> judge_conformity(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                                      const CellShapes& shapes, double planarity);

/// Whether two cells are folded (folded_face) along a face of `cell`; false where `other` has no
/// face with corners at the same places, or the turn of either tells nothing.
bool is_folded(const ZooMesh& mesh, const CellShapes& shapes, CellId cell, std::size_t face,
               CellId other);

/// A face without neighbour, its corners counter-clockwise as seen from outside its cell (as far as
/// the cell's turn tells).
struct FreeFace {
  CellId cell;
  std::uint8_t face;
  std::uint8_t corner_count;
  std::array<NodeId, 4> nodes;
};

/// All faces without neighbour, by cell, then face.
std::vector<FreeFace> free_faces(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                                 const FaceNumbering& numbering, const CellShapes& shapes);

}  // namespace hiac
