#pragma once

#include <cstdint>
#include <string_view>

#include "hiac/check/cells.hpp"
#include "hiac/order/order_basis.hpp"

namespace hiac {

/// Whether a mesh is Delaunay: the corners of every cell lie on a sphere that has no node inside.
enum class Delaunay : std::uint8_t {
  unknown,  ///< not asked: some cells are invalid or curved, or the mesh is not convex
  none,
  weak,   ///< some neighbours have a sphere in common, as the tetrahedra of a regular grid
  strict  ///< the corners of a cell's neighbours are outside of its sphere
};

/// Whether it is proven that a mesh has no visibility cycle from anywhere, and how.
enum class Acyclicity : std::uint8_t {
  delaunay,  ///< it is Delaunay, strictly
  regular,   ///< for some heights of the nodes, the mesh is the lower side of a polytope
  unknown    ///< not proven: cycles are possible, not certain
};

struct Certificate {
  Acyclicity acyclicity = Acyclicity::unknown;
  Delaunay delaunay = Delaunay::unknown;
  std::string_view reason;  ///< if the acyclicity is unknown: what is missing
};

/// Returns the certificate of H. Edelsbrunner, "An acyclicity theorem for cell complexes in d
/// dimensions", Combinatorica 10, 1990. Let heights of the nodes be an affine function in every
/// cell, such that across every shared face the next cell's function is greater on its side. Then
/// the functions' values at the eye decrease along every ray from cell to cell, so that no ray, and
/// no chain of rays, returns. (In a parallel view, their slopes along the rays decrease.) The mesh
/// must be one that no ray leaves and enters again (`basis.convex`), with linear cells of the same
/// orientation. Such cells do not overlap: the mesh's boundary winds once around every point
/// (overlap.hpp).
///
/// Squared distances from the origin are heights whose functions belong to the circumspheres; exact
/// predicates compare neighbours, which is enough in a convex mesh (B. Delaunay, "Sur la sphere
/// vide", 1934). Strictly Delaunay is a proof. If some neighbours have a sphere in common, it is
/// the same in both, and heights for these faces alone complete the proof: added to the squared
/// distances with a small enough factor, they leave the other faces as they are. For tetrahedra,
/// such heights, or heights for all faces of a mesh that is not Delaunay, are searched for by S.
/// Kaczmarz' projections onto the inequalities (1937); they count only if exact determinants
/// confirm them for every face. The search is limited: unknown does not mean that there are none.
Certificate certify_acyclic(const OrderBasis& basis, const CellShapes& shapes);

}  // namespace hiac
