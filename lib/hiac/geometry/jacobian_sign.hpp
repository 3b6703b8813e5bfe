#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// What the Jacobian determinant of a cell's isoparametric map is inside the cell.
enum class JacobianSign : std::uint8_t {
  positive,   ///< everywhere, where it is not on the boundary
  negative,   ///< everywhere: the cell is turned inside out as a whole, as its mirror image is
  mixed,      ///< somewhere positive and somewhere negative: no cell at all
  flat,       ///< zero everywhere: the cell has no volume
  undecided,  ///< none of these could be proven
};

/// Of any kind. `nodes`: positions of its node_count(kind) nodes. Values that are not farther from
/// zero than `tolerance` times the product of the lengths of the map's three derivatives, at most,
/// count as zero.
///
/// The determinant is a polynomial (for pyramids and wedges times a factor that is positive inside)
/// and lies between its least and its largest Bernstein coefficient; where these are of both signs
/// the cell is divided (A. Johnen, J.-F. Remacle, C. Geuzaine, "Geometrical validity of curvilinear
/// finite elements", 2013). Coefficients of one sign, some of them zero, are positive inside.
JacobianSign jacobian_sign(CellKind kind, std::span<const std::array<double, 3>> nodes,
                           double tolerance);

}  // namespace hiac
