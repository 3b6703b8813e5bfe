#pragma once

// The two values of a double that are no number one could write.
#include <limits>

namespace hiac {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace hiac
