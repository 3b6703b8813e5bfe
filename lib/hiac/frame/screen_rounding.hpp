#pragma once

#include <algorithm>
#include <cmath>

namespace hiac {

// How close to a pixel's centre a point counts as lying on it, in pixels. Nodes are projected to at
// most 131072 pixels from the picture's centre (projection.cpp), where coordinates are rounded by
// 2^-36; within pictures of up to 4096 pixels they are rounded by 2^-42 at most.

/// Projected nodes this close to the centres of a column or row of pixels are moved onto them:
/// faces seen edge-on along pixel centres, as in views along an axis, stay straight when their
/// corners are projected, and rays in them lie on one side throughout. The channel `error` counts
/// the move (Arithmetic::snap).
inline constexpr double kSnapToCenter = 0x1p-38;

/// An edge that crosses a row of centres at most this far right of a pixel's centre counts as
/// passing through it: this is slightly more than the rounding of projected coordinates. Thus faces
/// seen edge-on stay straight in any direction on the screen: rays in them lie on one side of all
/// their edges. `slope`: the edge's change of x by y.
inline constexpr double kMostOnCrossing = 0x1p-36;
inline double on_crossing(double slope) {
  return std::min(kMostOnCrossing, kSnapToCenter / 2 * (1 + std::abs(slope)));
}

/// Corners of curved faces this close to a pixel's centre count as lying on its ray: four times the
/// distance by which nodes are moved, and the largest correction of an edge crossing.
inline constexpr double kCornerOnRay = kMostOnCrossing;

/// Larger than any of these corrections: where one may have been made, a position is known only to
/// within this.
inline constexpr double kBesideCrossing = 2 * kMostOnCrossing;

}  // namespace hiac
