#pragma once

#include <cstdint>
#include <string_view>

#include "hiac/check/cells.hpp"
#include "hiac/order/order_basis.hpp"

namespace hiac {

/// Whether a mesh is proven to have no visibility cycle from anywhere, and by what.
enum class Acyclicity : std::uint8_t {
  delaunay,  ///< every cell's corners lie on a sphere, and its neighbours' others outside of it
  regular,   ///< heights of the nodes were found that make the mesh the lower side of a polytope
  unknown    ///< neither: cycles are possible, not certain
};

struct Certificate {
  Acyclicity acyclicity = Acyclicity::unknown;
  std::string_view reason;  ///< unknown: what is missing
};

/// The certificate of H. Edelsbrunner, "An acyclicity theorem for cell complexes in d dimensions",
/// Combinatorica 10, 1990: where heights of the nodes are, cell by cell, an affine function, and
/// across every shared face the next cell's function is the greater one on its side, the functions'
/// values at the eye decrease along every ray from cell to cell; so no ray, and no chain of rays,
/// comes back. (Parallel views: their slopes along the rays.) It needs a mesh that no ray leaves
/// and enters again: `basis.convex`; and linear cells that all turn alike.
///
/// Squared distances from the origin are heights whose functions belong to the circumspheres
/// (delaunay), asked exactly, faces between cells on one sphere not allowed. For tetrahedra others
/// are looked for where these fail, from them, by S. Kaczmarz' projections onto the inequalities
/// (1937); what is found counts only when exact determinants say so for every face. The search has
/// an end: unknown does not mean that there are none.
Certificate certify_acyclic(const OrderBasis& basis, const CellShapes& shapes);

}  // namespace hiac
