#pragma once

#include <array>

namespace hiac {

// How many roundings the model of error_bound.hpp counts, in units of roundoff (Arithmetic::unit).
// Every count is at least a third more than what counting operations gives.

/// Of projected coordinates: they are rounded once, from extended precision.
inline constexpr double kCoordinateRounding = 2;
/// Of the longest projected edge: places on faces are found relative to a corner by Gaussian
/// elimination or between edges, 15 roundings at most.
inline constexpr double kPlaceRounding = 20;
/// Of the largest depth: depths and what they divide by add up eleven, five on a corner of the
/// face and six along a row of pixels.
inline constexpr double kDepthRounding = 16;
/// The same where depths are found at once and not along rows of pixels.
inline constexpr double kPlaneDepthRounding = 8;

/// Of distances from the eye, where rays are followed in the world.
inline constexpr double kWorldRounding = 24;
/// Of a cell's size: what Newton's iteration leaves (inverse_map.cpp: a residual of 16 epsilon,
/// which is 32 units) and the map's own rounding.
inline constexpr double kMapRounding = 64;
/// kWorldRounding for curved faces, by order: control points add up to twelve nodes, places on
/// faces sixteen control points, 34 roundings at most; without their signs the weights of nodes in
/// places come to 1.5, 4.8 and 14.4 at most (all of PatchWeights).
inline constexpr std::array<double, 3> kCurvedRounding{64, 192, 512};

/// Of the condition of a gradient (gradient_condition): what an isosurface's normal is wrong by.
inline constexpr double kAngleRounding = 16;

}  // namespace hiac
