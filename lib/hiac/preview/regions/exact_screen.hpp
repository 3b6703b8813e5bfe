#pragma once

#include "hiac/preview/regions/screen_predicates.hpp"

namespace hiac::preview {

// The signs of screen_predicates.hpp without a filter: the slow path.
int exact_side(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c);
int exact_turn(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c,
               const ScreenPoint& d);
int exact_side_of_crossing(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c,
                           const ScreenPoint& d, const ScreenPoint& e, const ScreenPoint& f);
/// (b - a) x (c - a), rounded once.
double exact_twice_area(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c);

}  // namespace hiac::preview
