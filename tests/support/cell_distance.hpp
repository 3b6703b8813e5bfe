#pragma once

#include "hiac/mesh/zoo_mesh.hpp"
#include "tests/support/extended_vectors.hpp"

namespace hiac::test {

/// An upper bound of how far a point is from a cell, in extended precision: from the best point of
/// it that Newton's iteration on its map comes by, from the middle and from near the corners. What
/// lies in a cell whose Jacobian is positive is found to be there.
///
/// Shares nothing with the engine but the shape functions.
long double distance_from(const ZooMesh& mesh, CellId cell, const ExtendedVec& point);

}  // namespace hiac::test
