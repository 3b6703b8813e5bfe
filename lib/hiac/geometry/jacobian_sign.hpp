#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// The sign of the Jacobian determinant of a cell's isoparametric map inside the cell.
enum class JacobianSign : std::uint8_t {
  positive,   ///< everywhere inside
  negative,   ///< everywhere inside: the cell is a mirror image, turned inside out as a whole
  mixed,      ///< somewhere positive and somewhere negative: not a valid cell
  flat,       ///< zero everywhere: the cell has no volume
  undecided,  ///< none of these could be proven
};

/// Returns the sign for a cell of any kind. `nodes`: positions of its node_count(kind) nodes. A
/// value counts as zero when its magnitude is at most `tolerance` times the largest product of the
/// lengths of the map's three derivatives.
///
/// The determinant, for pyramids and wedges times a factor that is positive inside, is a polynomial
/// and lies between its least and its largest Bernstein coefficient. Where these have different
/// signs the cell is divided (A. Johnen, J.-F. Remacle, C. Geuzaine, "Geometrical validity of
/// curvilinear finite elements", 2013). If some coefficients are positive and the others zero, the
/// determinant is positive inside; likewise for negative ones.
JacobianSign jacobian_sign(CellKind kind, std::span<const std::array<double, 3>> nodes,
                           double tolerance);

}  // namespace hiac
