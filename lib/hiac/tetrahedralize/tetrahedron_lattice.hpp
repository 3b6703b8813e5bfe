#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// A point of a tetrahedron: its barycentric coordinates multiplied by an integer n, which is their
/// sum.
using LatticePoint = std::array<std::uint16_t, 4>;

/// Returns the lattice points of a tetrahedron's nodes, in their order; n is the order of the
/// tetrahedron.
std::vector<LatticePoint> nodes_on_lattice(CellOrder order);

/// A tetrahedron between four points of another's lattice.
using LatticeTetrahedron = std::array<LatticePoint, 4>;

/// Returns the 8^levels tetrahedra, with the orientation of the original, that result from halving
/// all edges of a tetrahedron `levels` times; their corners are on the lattice n = 2^levels.
///
/// Each halving leaves four children at the corners, and cuts the octahedron between them along the
/// diagonal from the middle of edge 0-2 to that of edge 1-3 (J. Bey, "Tetrahedral grid refinement",
/// Computing 55, 1995: at most three shapes result, whatever the number of levels). Every face is
/// divided into four in the same way, as seen from either cell.
std::vector<LatticeTetrahedron> halved(unsigned levels);

}  // namespace hiac
