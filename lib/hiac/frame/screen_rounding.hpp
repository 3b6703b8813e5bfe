#pragma once

#include <algorithm>
#include <cmath>

namespace hiac {

// What counts as lying on a pixel's centre, in pixels. Nodes are projected to at most 131072 pixels
// from the picture's centre (projection.cpp), where coordinates are rounded by 2^-36; within
// pictures of up to 4096 pixels they are rounded by 2^-42 at most.

/// Projected nodes as close as this to the centres of a column or row of pixels are moved onto
/// them: faces seen edge-on along pixel centres, as views along an axis have them, stay straight
/// when their corners are projected, and rays in them lie on one side all along. The channel
/// `error` counts the move (Arithmetic::snap).
inline constexpr double kSnapToCenter = 0x1p-38;

/// An edge may cross a row of centres this far right of a pixel's centre and still count as going
/// through it: this is what rounding of projected coordinates can do, and a little more. Faces seen
/// edge-on so stay straight whichever way they run across the screen: rays in them lie on one side
/// of all their edges. `slope`: the edge's change of x by y.
inline constexpr double kMostOnCrossing = 0x1p-36;
inline double on_crossing(double slope) {
  return std::min(kMostOnCrossing, kSnapToCenter / 2 * (1 + std::abs(slope)));
}

/// Corners of curved faces this near to a pixel's centre lie on its ray: four times what nodes are
/// moved by, as far as the sides of edges are ever corrected.
inline constexpr double kCornerOnRay = kMostOnCrossing;

/// More than any of these corrections: a place is not known better where they may have been made.
inline constexpr double kBesideCrossing = 2 * kMostOnCrossing;

}  // namespace hiac
