#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace hiac {

/// Returns the tuples of `width` values with these numbers, in their order.
template <typename T, typename Numbers>
std::vector<T> chosen_tuples(std::span<const T> values, std::size_t width, const Numbers& numbers) {
  std::vector<T> result(numbers.size() * width);
  auto to = result.begin();
  for (const auto number : numbers)
    to = std::ranges::copy(values.subspan(std::size_t{number} * width, width), to).out;
  return result;
}

}  // namespace hiac
