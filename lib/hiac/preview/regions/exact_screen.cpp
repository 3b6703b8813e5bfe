#include "hiac/preview/regions/exact_screen.hpp"

#include <CGAL/Mpzf.h>

// CGAL's kernel and number types are LGPL; nothing of its GPL parts is used here.

namespace hiac::preview {
namespace {

using Exact = CGAL::Mpzf;  // a ring: sums, differences and products of doubles without rounding

Exact cross(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c,
            const ScreenPoint& d) {
  return (Exact(b.x) - Exact(a.x)) * (Exact(d.y) - Exact(c.y)) -
         (Exact(b.y) - Exact(a.y)) * (Exact(d.x) - Exact(c.x));
}

int sign(const Exact& number) { return static_cast<int>(CGAL::sign(number)); }

}  // namespace

int exact_side(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c) {
  return sign(cross(a, b, a, c));
}

int exact_turn(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c,
               const ScreenPoint& d) {
  return sign(cross(a, b, c, d));
}

int exact_side_of_crossing(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c,
                           const ScreenPoint& d, const ScreenPoint& e, const ScreenPoint& f) {
  const Exact numerator =
      cross(a, b, a, d) * cross(e, f, e, c) - cross(a, b, a, c) * cross(e, f, e, d);
  return -sign(numerator) * sign(cross(e, f, c, d));
}

double exact_twice_area(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c) {
  return CGAL::to_double(cross(a, b, a, c));
}

}  // namespace hiac::preview
