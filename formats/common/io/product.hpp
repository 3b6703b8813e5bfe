#pragma once

#include <concepts>
#include <limits>
#include <vector>

namespace hiac::formats {

/// The product of extents that a file declares; the largest number when it overflows.
template <std::unsigned_integral Count>
Count product(const std::vector<Count>& factors) {
  Count result = 1;
  for (const Count factor : factors)
    if (__builtin_mul_overflow(result, factor, &result)) return std::numeric_limits<Count>::max();
  return result;
}

}  // namespace hiac::formats
