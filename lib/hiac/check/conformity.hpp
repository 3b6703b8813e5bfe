#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hiac/check/cells.hpp"
#include "hiac/check/defect.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/faces/face_numbering.hpp"

namespace hiac {

/// Checks how the cells of a mesh fit together across their faces:
///
/// - adjacency: the mesh stores neighbours that differ from `adjacency`, which build_face_adjacency
///   computed;
/// - overshared_face: three or more cells have a face with the same corners (listed by cell);
/// - folded_face: two cells lie on the same side of their common face, according to their
///   orientations, or have its four corners in a different order around it: their interiors overlap
///   next to it;
/// - torn_interface, hanging_interface, sliding_interface: a face without neighbour lies on those
///   of other cells, which are on its other side: on a face with corners at the same places (but
///   other nodes), on smaller faces or within a larger one, or neither. A face gets the first of
///   these that applies.
///
/// Faces lie on one another if they do so to within `planarity` times their size plus their own
/// deviations from planes; with planarity = 0, exact determinants decide.
std::vector<Finding> judge_conformity(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                                      const CellShapes& shapes, double planarity);

/// Returns whether two cells are folded (folded_face) along a face of `cell`; false if `other` has
/// no face with corners at the same places, or the orientation of either is unknown.
bool is_folded(const ZooMesh& mesh, const CellShapes& shapes, CellId cell, std::size_t face,
               CellId other);

/// A face without neighbour, its corners counter-clockwise as seen from outside its cell (if the
/// cell's orientation is known).
struct FreeFace {
  CellId cell;
  std::uint8_t face;
  std::uint8_t corner_count;
  std::array<NodeId, 4> nodes;
};

/// Returns all faces without neighbour, by cell, then face.
std::vector<FreeFace> free_faces(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                                 const FaceNumbering& numbering, const CellShapes& shapes);

}  // namespace hiac
