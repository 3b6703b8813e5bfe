#pragma once

#include <cstdint>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

struct Subdivision {
  /// Make linear tetrahedra of cells of every order; else tetrahedra have the order of the cell
  /// that they are part of.
  bool linearize = false;
  /// With `linearize`: halve the edges of the tetrahedra that often. Each time there are eight
  /// times as many, and the field's error is a quarter (of quadratic cells).
  unsigned levels = 0;
};
inline constexpr unsigned kMostSubdivisionLevels = 6;

struct SubdividedMesh {
  ZooMesh mesh;
  std::uint64_t new_nodes = 0;      ///< that the given mesh did not have
  std::uint64_t dropped_nodes = 0;  ///< that no tetrahedron needs
  /// Flat ones, of linear cells with corners at one place or in one plane.
  std::uint64_t dropped_tetrahedra = 0;
};

/// A conforming mesh of tetrahedra that fills the cells of another (cut_cell); tetrahedra stay what
/// they are, unless they are linearized. Cells come in the order of the cells that they are of.
/// Where tetrahedra of a cell would be flat or turned inside out, as faces that are not planar can
/// bring about, the cell is cut otherwise, around a node in its centre if need be (choose_cut), and
/// faces are cut by their other diagonal (choose_diagonals); flat ones of linear cells are left
/// out.
///
/// New nodes, in the middles of faces and cells, lie where the cell's isoparametric map has the
/// middles (or thirds, or parts of a half, ...) of its reference cell; both cells at a face compute
/// the same place from the face's nodes, and the first of them is taken. Node and corner fields are
/// interpolated there by the cell's shape functions, cell fields handed on. So a field that is
/// quadratic in an affine quadratic cell is the same field in its 10-node tetrahedra, and one that
/// is cubic in an affine cubic cell in its 20-node ones; in other cells of more than four corners
/// the tetrahedra's interpolant differs from theirs between the nodes.
///
/// Metadata is kept, adjacency is not. Requires a mesh that validate() lets pass and levels <=
/// kMostSubdivisionLevels; throws InputError when more than 2^32 - 1 nodes or cells would result.
SubdividedMesh subdivide_cells(const ZooMesh& mesh, const Subdivision& how);

}  // namespace hiac
