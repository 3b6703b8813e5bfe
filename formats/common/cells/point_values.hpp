#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hiac::formats {

/// Values that differ by less than this, relative to the largest value, are the same.
inline constexpr double kSameDouble = 1e-12;
inline constexpr double kSameSingle = 1e-6;

/// Values at all points: the coordinates, or a field.
struct PointValues {
  std::string name;
  std::size_t width;
  std::vector<double> values;
  double same = 0;  ///< values that differ by less are the same
  double unit = 0;  ///< of the last digit, of values that were rounded to digits; otherwise 0
  double low = 0;
  double high = 0;
};

PointValues point_values(std::string name, std::size_t width, std::vector<double>&& values);

}  // namespace hiac::formats
