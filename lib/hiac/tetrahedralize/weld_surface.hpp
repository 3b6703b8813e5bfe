#pragma once

#include <cstddef>

#include "hiac/tetrahedralize/surface.hpp"

namespace hiac {

/// What weld_surface has done.
struct WeldCounts {
  std::size_t points = 0;  ///< that became another one
  std::size_t facets = 0;  ///< that were left without area by that, and are gone
  double farthest = 0;     ///< the largest distance that a point moved
};

/// Joins points of a surface that are at most `tolerance` apart, in world units (0: at the same
/// place): each becomes the nearest of the points before it that stay, of two as near the first.
/// Facets of one polygon lose corners that have become one, and go when fewer than three are left.
/// Points that stay keep their place and their order.
WeldCounts weld_surface(Surface& surface, double tolerance);

}  // namespace hiac
