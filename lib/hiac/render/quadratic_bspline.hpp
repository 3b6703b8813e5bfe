#pragma once

#include <cmath>

namespace hiac {

/// Half the width of the kernel, in pixels.
inline constexpr double kBsplineReach = 1.5;

/// The quadratic B-spline: a box of a pixel's width convolved with itself twice (section 5.3). Its
/// integral is 1, and so is the sum of its values at any points that lie a pixel apart. `offset`:
/// distance from its middle, in pixels.
inline double quadratic_bspline(double offset) {
  const double d = std::abs(offset);
  if (d <= 0.5) return 0.75 - d * d;
  return d < kBsplineReach ? 0.5 * (kBsplineReach - d) * (kBsplineReach - d) : 0;
}

}  // namespace hiac
