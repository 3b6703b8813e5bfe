#include "formats/common/mesh/format.hpp"

#include "hiac/base/finite_range.hpp"

namespace hiac::formats {

void summarize_values(std::span<const double> values, FieldSummary& summary) {
  const FiniteRange range(values);
  summary.low = range.low;
  summary.high = range.high;
  summary.not_finite = range.not_finite;
}

}  // namespace hiac::formats
