#pragma once

#include <cstddef>

namespace hiac {

/// Returns n over k; exact if the result is below 2^53.
inline double binomial(std::size_t n, std::size_t k) {
  double value = 1;
  for (std::size_t i = 1; i <= k; ++i)
    value = value * static_cast<double>(n - k + i) / static_cast<double>(i);
  return value;
}

}  // namespace hiac
