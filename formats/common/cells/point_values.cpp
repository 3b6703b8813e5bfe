#include "formats/common/cells/point_values.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "formats/common/io/written_digits.hpp"

namespace hiac::formats {

PointValues point_values(std::string name, std::size_t width, std::vector<double>&& values) {
  PointValues result{std::move(name), width, std::move(values)};
  bool single = true;
  double largest = 0;
  result.low = HUGE_VAL;
  result.high = -HUGE_VAL;
  for (const double value : result.values) {
    if (!std::isfinite(value)) continue;
    single = single && static_cast<double>(static_cast<float>(value)) == value;
    largest = std::max(largest, std::abs(value));
    result.low = std::min(result.low, value);
    result.high = std::max(result.high, value);
  }
  result.same = largest * (single ? kSameSingle : kSameDouble);
  result.unit = unit_of_last_digit(result.values);
  return result;
}

}  // namespace hiac::formats
