#pragma once

#include <cstdint>
#include <vector>

#include "hiac/check/defect.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// How a cell's map turns space.
enum class Turn : std::uint8_t {
  right,     ///< its Jacobian is positive inside, and at no place of the cell negative
  left,      ///< the same of a cell whose nodes are numbered in the mirror
  flat,      ///< the corners lie in one plane
  mixed,     ///< the Jacobian is positive here and negative there, or zero inside
  undecided  ///< the proof was given up
};

/// What the cells of a mesh are, each for itself.
struct CellShapes {
  std::vector<Turn> turns;  ///< of every cell
  /// How most of the cells turn that turn at all: the mesh's handedness. A whole mesh of left cells
  /// is a convention; a cell that turns otherwise than the mesh is inverted.
  Turn hand = Turn::right;
  /// Every cell turns as the mesh does.
  bool uniform = true;
  std::vector<Finding> findings;
};

/// Judges every cell by itself: zero_volume, inverted, jacobian, jacobian_undecided, left_handed,
/// nonplanar_face, nonconvex_cell. The mesh's numbers have to be right.
///
/// A tetrahedron's sign is that of one exact determinant. Those of other linear cells are asked
/// exactly at the corners where three edges meet; what the corners leave open, and all of curved
/// cells, is proven by Bernstein coefficients (jacobian_sign), in which rounding counts as zero.
///
/// Of faces and convexity: a face counts as planar when its nodes deviate from a plane by no more
/// than `planarity` times its size; a linear cell is convex when no corner lies outside of a plane
/// through three corners of a face that it is not on, exactly, by more than that. A cell with a
/// face that is not planar is named for that alone where nothing else is wrong with it. With
/// planarity = 0 nothing is rounded away: the quadrilaterals then are planar or not by an exact
/// determinant. Convexity is not asked of curved cells.
CellShapes judge_cells(const ZooMesh& mesh, double planarity);

/// The largest deviation of a cell's faces from planes, relative to their sizes: that of the
/// diagonals of linear quadrilaterals (quadrilateral_deviation), and that of nodes between corners
/// from the plane of the corners. Exactly 0 where, and only where, all determinants vanish.
double face_deviation(const ZooMesh& mesh, CellId cell);

/// Whether a linear cell is convex, in the sense of judge_cells.
bool is_convex(const ZooMesh& mesh, CellId cell, Turn turn, double planarity);

}  // namespace hiac
