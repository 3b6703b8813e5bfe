#pragma once

#include <cstdint>
#include <vector>

#include "hiac/check/defect.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The orientation of a cell's map.
enum class Turn : std::uint8_t {
  right,     ///< its Jacobian is positive inside and nowhere in the cell negative
  left,      ///< the same for a cell whose nodes are numbered in mirror image
  flat,      ///< the corners lie in one plane
  mixed,     ///< the Jacobian has both signs, or is zero inside
  undecided  ///< the proof was abandoned
};

/// The orientation and the defects of a mesh's cells, each considered by itself.
struct CellShapes {
  std::vector<Turn> turns;  ///< of every cell
  /// The mesh's handedness: the orientation of most of its right and left cells. That all cells of
  /// a mesh are left is a convention; a cell whose orientation differs from the mesh's is inverted.
  Turn hand = Turn::right;
  /// True if all cells have the mesh's orientation.
  bool uniform = true;
  std::vector<Finding> findings;
};

/// Checks every cell by itself for zero_volume, inverted, jacobian, jacobian_undecided,
/// left_handed, nonplanar_face and nonconvex_cell. The mesh's numbers must be valid
/// (judge_numbers).
///
/// One exact determinant decides the sign of a tetrahedron. For other linear cells, exact
/// determinants decide at the corners where three edges meet; for what these leave open, and for
/// curved cells, Bernstein coefficients are the proof (jacobian_sign), in which values within
/// rounding count as zero.
///
/// Faces and convexity: a face counts as planar if its nodes deviate from a plane by at most
/// `planarity` times its size. A linear cell is convex if, for three corners of each face, no
/// corner off the face lies outside their plane, exactly, by more than that. A cell whose only
/// defect is a face that is not planar gets no other finding. With planarity = 0 nothing is
/// tolerated: an exact determinant decides whether a quadrilateral is planar. Convexity is not
/// tested for curved cells.
CellShapes judge_cells(const ZooMesh& mesh, double planarity);

/// Returns the largest deviation of a cell's faces from planes, relative to their sizes: that of
/// the diagonals of linear quadrilaterals (quadrilateral_deviation), and that of nodes between
/// corners from the plane of the corners. Exactly 0 if and only if all determinants vanish.
double face_deviation(const ZooMesh& mesh, CellId cell);

/// Returns whether a linear cell is convex, as defined at judge_cells.
bool is_convex(const ZooMesh& mesh, CellId cell, Turn turn, double planarity);

}  // namespace hiac
