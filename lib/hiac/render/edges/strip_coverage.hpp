#pragma once

namespace hiac {

/// A straight line on the screen with a width, pixels: the rectangle of all points beside it at
/// most half of the width away. It ends where the line ends.
struct Strip {
  double x0, y0, x1, y1;
  double width;
};

/// The share of a pixel, the unit square around (x, y), that a strip covers: the exact area.
double strip_coverage(const Strip& strip, double x, double y);

}  // namespace hiac
