#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/transfer_function.hpp"
#include "hiac/scene/scene.hpp"
#include "hiac/scene/toml/spec_key.hpp"
#include "hiac/scene/toml/spec_value.hpp"

namespace hiac {

/// Reads a list of points [scalar, value ...]: at least one, scalars not decreasing, values not
/// negative. Three values are a colour, none above kLargestColor; a single one is an extinction,
/// which has no limit.
template <std::size_t N>
void read_points(const SpecValue& value, std::vector<typename PiecewiseLinear<N>::Point>& into) {
  const std::vector<SpecValue> rows = value.list();
  if (rows.empty()) value.fail("empty (expected at least one point)");
  into.clear();
  into.reserve(rows.size());
  for (const SpecValue& row : rows) {
    const std::vector<SpecValue> numbers = row.list(N + 1);
    auto& point = into.emplace_back();
    point.scalar = numbers[0].number();
    for (std::size_t c = 0; c < N; ++c) {
      point.value[c] = numbers[c + 1].at_least_finite(0);
      if (N == 3 && point.value[c] > kLargestColor) numbers[c + 1].fail_bright(point.value[c]);
    }
    if (into.size() > 1 && point.scalar < into[into.size() - 2].scalar)
      row.fail(fmt::format("scalars must not decrease (point {} has {} after {})", into.size(),
                           point.scalar, into[into.size() - 2].scalar));
  }
}

/// Returns the list as TOML, one point per line.
template <std::size_t N>
std::string points_text(const std::vector<typename PiecewiseLinear<N>::Point>& points) {
  std::string text = "[";
  for (const auto& point : points) {
    std::array<double, N + 1> row{point.scalar};
    std::copy(point.value.begin(), point.value.end(), row.begin() + 1);
    text += "\n  " + toml_text(std::span<const double>(row)) + ",";
  }
  return text + "\n]";
}

}  // namespace hiac
