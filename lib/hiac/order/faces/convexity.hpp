#pragma once

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Returns true only if it is certain that no straight line meets the mesh in more than one piece.
///
/// A closed connected surface that is convex along each of its edges bounds a convex body (H.
/// Tietze, 1928; S. Nakajima, 1928). Hence the unmatched faces must form one edge-connected surface
/// with two faces at every edge; at every edge, no corner of either face may lie outside the plane
/// of the other, nor may the faces be folded onto one another in one plane (as at the front of a
/// crack of no width). It must also not wind around more than once, as that of cells that go around
/// an edge twice does. Exact determinants decide. A result of false proves nothing.
bool boundary_is_convex(const ZooMesh& mesh, const FaceAdjacency& adjacency);

}  // namespace hiac
