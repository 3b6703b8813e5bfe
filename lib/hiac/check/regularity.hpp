#pragma once

#include <cstdint>
#include <string_view>

#include "hiac/check/cells.hpp"
#include "hiac/order/order_basis.hpp"

namespace hiac {

/// Whether it is proven that a mesh has no visibility cycle from anywhere, and how.
enum class Acyclicity : std::uint8_t {
  delaunay,  ///< a cell's corners lie on a sphere, those of its neighbours outside
  regular,   ///< for some heights of the nodes, the mesh is the lower side of a polytope
  unknown    ///< not proven: cycles are possible, not certain
};

struct Certificate {
  Acyclicity acyclicity = Acyclicity::unknown;
  std::string_view reason;  ///< if unknown: what is missing
};

/// Returns the certificate of H. Edelsbrunner, "An acyclicity theorem for cell complexes in d
/// dimensions", Combinatorica 10, 1990. Let heights of the nodes be an affine function in every
/// cell, such that across every shared face the next cell's function is greater on its side. Then
/// the functions' values at the eye decrease along every ray from cell to cell, so that no ray, and
/// no chain of rays, returns. (In a parallel view, their slopes along the rays decrease.) The mesh
/// must be one that no ray leaves and enters again (`basis.convex`), with linear cells of the same
/// orientation.
///
/// Squared distances from the origin are heights whose functions belong to the circumspheres
/// (delaunay); exact predicates test them, and two neighbours must not have a common circumsphere.
/// If they fail for tetrahedra, they are the start of a search for other heights, by S. Kaczmarz'
/// projections onto the inequalities (1937); heights count only if exact determinants confirm them
/// for every face. The search is limited: unknown does not mean that there are none.
Certificate certify_acyclic(const OrderBasis& basis, const CellShapes& shapes);

}  // namespace hiac
