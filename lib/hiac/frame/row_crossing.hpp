#pragma once

#include "hiac/frame/projection.hpp"
#include "hiac/frame/screen_rounding.hpp"

namespace hiac {

// Where a row of pixel centres crosses a projected edge. Every scan of every kind of cell computes
// crossings by these functions, so that an edge lies on the same side of a pixel's centre for all
// cells around it. `V` is double or a vector of doubles. The operations are not fused: they give
// the same numbers in scalars and in vectors, on every machine.

/// The change of x by y along the edge from a to b.
inline double edge_slope(const ProjectedNode& a, const ProjectedNode& b) {
  return (b.x - a.x) / (b.y - a.y);
}

/// The x at which the edge from (x, y) crosses a row of centres.
inline double crossing_x(double center, double x, double y, double slope) {
  return x + (center - y) * slope;
}

/// The number to subtract from crossing_x before rounding up, to obtain the first pixel whose
/// centre lies on the crossing or right of it.
inline double to_first_pixel(double slope) { return 0.5 + on_crossing(slope); }

}  // namespace hiac
