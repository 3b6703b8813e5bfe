#pragma once

#include <cmath>

namespace hiac::preview {

/// A point of the screen, pixels.
struct ScreenPoint {
  double x, y;

  bool operator==(const ScreenPoint&) const = default;
};

inline int sign_of(double number) { return number > 0 ? 1 : number < 0 ? -1 : 0; }

// Exact signs (-1, 0, 1) for the coordinates as given (finite, magnitudes below 1e60 and, where not
// zero, differences above 1e-60). A floating-point filter decides almost always; then arithmetic
// without rounding in doubles where the numbers allow it (points of lattices); then CGAL's ring.
// Signs are those of x to the right and y up; with y down, everything is mirrored.

/// On which side of the line from a to b the point c lies: 1 left, 0 on it.
int side(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c);

/// The sign of (b - a) x (d - c): 1 when the second vector points to the left of the first.
int turn(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c, const ScreenPoint& d);

/// The side of the line from a to b on which the lines cd and ef meet. They are not parallel.
int side_of_crossing(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c,
                     const ScreenPoint& d, const ScreenPoint& e, const ScreenPoint& f);

/// (b - a) x (c - a), rounded once.
double doubtful_twice_area(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c);

/// (b - a) x (c - a), to a relative error of 1e-9; its sign is that of `side`.
inline double twice_area(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c) {
  const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
  const double value = left - right;
  // 2^30 times what rounding may do, and far from underflow
  if (std::abs(value) > 0x1p-20 * (std::abs(left) + std::abs(right)) + 0x1p-500) return value;
  return doubtful_twice_area(a, b, c);
}

}  // namespace hiac::preview
