#pragma once

#include <array>

namespace hiac {

// How many roundings the model of error_bound.hpp counts, in units of roundoff (Arithmetic::unit).
// Every count is at least a third more than what counting operations gives.

/// Of projected coordinates, which are rounded once, from extended precision.
inline constexpr double kCoordinateRounding = 2;
/// Of the longest projected edge: places on faces are found relative to a corner by Gaussian
/// elimination or between edges, 15 roundings at most.
inline constexpr double kPlaceRounding = 20;
/// Of the largest depth: depths and their divisors accumulate eleven roundings, five at a corner of
/// the face and six along a row of pixels.
inline constexpr double kDepthRounding = 16;
/// The same where depths are computed directly and not along rows of pixels.
inline constexpr double kPlaneDepthRounding = 8;

/// Of the distance from the eye, where rays are followed in the world.
inline constexpr double kWorldRounding = 24;
/// Of a cell's size: the residual of Newton's iteration (inverse_map.cpp: a residual of 16 epsilon,
/// which is 32 units) and the map's own rounding.
inline constexpr double kMapRounding = 64;
/// kWorldRounding for curved faces, by order: control points are sums over up to twelve nodes,
/// points on faces sums over up to sixteen control points, 34 roundings at most; the magnitudes of
/// the nodes' weights at a point sum to 1.5, 4.8 and 14.4 at most (over all PatchWeights).
inline constexpr std::array<double, 3> kCurvedRounding{64, 192, 512};

/// Of the condition of a gradient (gradient_condition): the error of an isosurface's normal.
inline constexpr double kAngleRounding = 16;

}  // namespace hiac
