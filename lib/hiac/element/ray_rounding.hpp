#pragma once

namespace hiac {

// Rounding errors of a field that is evaluated at a point of a ray through the inverse of a cell's
// map, in units of roundoff. Smaller coefficients of interpolants are noise.

/// Of the field's largest value in the cell.
inline constexpr double kRayValueRounding = 8;
/// Of its range there, times the map's steepness and the largest coordinate of the point: the
/// change of the reference coordinates by rounding of the point.
inline constexpr double kRayPointRounding = 16;

}  // namespace hiac
