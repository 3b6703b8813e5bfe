#pragma once

#include <algorithm>
#include <limits>

namespace hiac {

/// A closed range; made empty.
struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  void widen(double by) {
    low -= by;
    high += by;
  }
};

}  // namespace hiac
