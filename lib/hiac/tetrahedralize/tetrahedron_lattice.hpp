#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// A point of a tetrahedron: barycentric coordinates times a whole number n that they add up to.
using LatticePoint = std::array<std::uint16_t, 4>;

/// The places of a tetrahedron's nodes, times its order, in the order of the nodes.
std::vector<LatticePoint> nodes_on_lattice(CellOrder order);

/// A tetrahedron between four points of another's lattice.
using LatticeTetrahedron = std::array<LatticePoint, 4>;

/// A tetrahedron halved along all edges `levels` times: 8^levels tetrahedra that turn as it does,
/// with corners on the lattice n = 2^levels.
///
/// Four children stay at the corners, the octahedron between them is cut along the diagonal from
/// the middle of edge 0-2 to that of edge 1-3 (J. Bey, "Tetrahedral grid refinement", Computing 55,
/// 1995: their shapes are at most three, however many the levels). On every face it is the same
/// division in four whatever cell it is seen from.
std::vector<LatticeTetrahedron> halved(unsigned levels);

}  // namespace hiac
