#include "formats/common/mesh/format.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hiac::formats {

void summarize_values(std::span<const double> values, FieldSummary& summary) {
  summary.low = std::numeric_limits<double>::infinity();
  summary.high = -std::numeric_limits<double>::infinity();
  summary.not_finite = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) {
      ++summary.not_finite;
      continue;
    }
    summary.low = std::min(summary.low, value);
    summary.high = std::max(summary.high, value);
  }
}

}  // namespace hiac::formats
