#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// A kind's reference cell cut into tetrahedra: those between its centre and the triangles of its
/// faces, each with its edges halved once. The linear tetrahedron is whole.
///
///     tetrahedron   linear 1, else 32
///     pyramid       48
///     prism         64
///     wedge         80
///     brick         96
struct CellPieces {
  /// The values of the kind's shape functions at a point, for every corner of the pieces.
  std::vector<std::vector<double>> points;
  std::vector<std::array<std::uint16_t, 4>> pieces;  ///< points
};

/// Made once for each kind.
const CellPieces& cell_pieces(CellKind kind);

}  // namespace hiac
