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
  void include(const Interval& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
  void widen(double by) {
    low -= by;
    high += by;
  }
  [[nodiscard]] bool empty() const { return !(low <= high); }
};

}  // namespace hiac
