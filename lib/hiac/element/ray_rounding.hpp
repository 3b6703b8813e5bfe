#pragma once

namespace hiac {

// What rounding leaves of a field that is evaluated at a point of a ray through the inverse of a
// cell's map, in units of roundoff. Coefficients of interpolants smaller than that are noise.

/// Of the field's largest value in the cell.
inline constexpr double kRayValueRounding = 8;
/// Of its range there, times the map's steepness and the largest coordinate of the point: what
/// rounding of the point moves the reference coordinates by.
inline constexpr double kRayPointRounding = 16;

}  // namespace hiac
