#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace hiac {

/// The range of the finite ones among some numbers, and how many others there are. The empty range
/// has low > high.
struct FiniteRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  std::uint64_t not_finite = 0;

  FiniteRange() = default;
  explicit FiniteRange(std::span<const double> values) {
    for (const double value : values) include(value);
  }

  void include(double value) {
    if (!std::isfinite(value)) {
      ++not_finite;
      return;
    }
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] bool empty() const { return low > high; }
};

}  // namespace hiac
