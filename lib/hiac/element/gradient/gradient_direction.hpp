#pragma once

#include <array>

namespace hiac {

/// Unit vector along the gradient of a field in a cell: J^-T g / |J^-T g| up to the sign, with the
/// map's Jacobian J given by its columns, and g the gradient in reference coordinates. The
/// cofactors of J replace its inverse, so that cells of volume 0 have a normal too: that of the
/// plane in which they lie. (0, 0, 1) if the cell has no area.
std::array<double, 3> gradient_direction(const std::array<std::array<double, 3>, 3>& columns,
                                         const std::array<double, 3>& reference_gradient);

}  // namespace hiac
