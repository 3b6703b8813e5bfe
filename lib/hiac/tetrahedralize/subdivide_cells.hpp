#pragma once

#include <cstdint>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

struct Subdivision {
  /// Makes linear tetrahedra of cells of every order; otherwise tetrahedra have the order of their
  /// cell.
  bool linearize = false;
  /// With `linearize`: how often the edges of the tetrahedra are halved. Each time their number
  /// grows by a factor of eight, and the field's error falls to a quarter (in quadratic cells).
  unsigned levels = 0;
};
inline constexpr unsigned kMostSubdivisionLevels = 6;

struct SubdividedMesh {
  ZooMesh mesh;
  std::uint64_t new_nodes = 0;      ///< nodes that the given mesh did not have
  std::uint64_t dropped_nodes = 0;  ///< nodes that no tetrahedron needs
  /// Flat tetrahedra of linear cells with corners at the same place or in one plane.
  std::uint64_t dropped_tetrahedra = 0;
};

/// Returns a conforming mesh of tetrahedra that fills the cells of another (cut_cell); tetrahedra
/// stay unchanged unless they are linearized. The tetrahedra come in the order of their cells. If
/// tetrahedra of a cell would be flat or inverted, as happens if faces are not planar, the cell is
/// cut differently, around a node in its centre if necessary (choose_cut), and faces are cut by
/// their other diagonal (choose_diagonals); flat ones of linear cells are omitted.
///
/// New nodes, in the middles of faces and cells, are the images, under the cell's isoparametric
/// map, of the middles (or thirds, or dyadic fractions, ...) of its reference cell; both cells at a
/// face compute the same position from the face's nodes, and the first one is used. Node and corner
/// fields are interpolated there by the cell's shape functions; cell fields are copied. A field
/// that is quadratic in an affine quadratic cell is therefore the same field in its 10-node
/// tetrahedra, and one that is cubic in an affine cubic cell in its 20-node ones; in other cells of
/// more than four corners the tetrahedra's interpolant differs from theirs between the nodes.
///
/// Metadata is kept, adjacency is not. Requires a mesh that satisfies validate() and levels <=
/// kMostSubdivisionLevels; throws InputError if more than 2^32 - 1 nodes or cells would result.
SubdividedMesh subdivide_cells(const ZooMesh& mesh, const Subdivision& how);

}  // namespace hiac
