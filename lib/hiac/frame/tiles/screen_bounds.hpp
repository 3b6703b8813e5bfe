#pragma once

#include <algorithm>
#include <limits>

#include "hiac/frame/frame.hpp"

namespace hiac {

/// A bounding box on the screen, in pixels, and of ray parameters; initially empty.
struct ScreenBounds {
  double x0 = std::numeric_limits<double>::infinity(), y0 = x0, x1 = -x0, y1 = -x0;
  double nearest = x0, farthest = -x0;
  bool in_front = true;  ///< all lies in front of the eye; else no bounds on the screen

  void include(double x, double y) {
    x0 = std::min(x0, x);
    y0 = std::min(y0, y);
    x1 = std::max(x1, x);
    y1 = std::max(y1, y);
  }
  void include_parameter(double t) {
    nearest = std::min(nearest, t);
    farthest = std::max(farthest, t);
  }
  /// Includes a control point (curved_outline.hpp).
  void include(double x, double y, double w, double t) {
    in_front = in_front && w > 0;
    include(x / w, y / w);
    include_parameter(t);
  }
};

/// The bounds of a cell, from its corners, or from the control points of its curved edges and
/// faces.
ScreenBounds screen_bounds(const Frame& frame, CellId cell);

}  // namespace hiac
