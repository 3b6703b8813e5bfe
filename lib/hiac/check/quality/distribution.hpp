#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hiac {

/// The percentages of the percentiles in a Distribution.
inline constexpr std::array<unsigned, 7> kPercents{1, 5, 25, 50, 75, 95, 99};

/// How many values fall between the edges: counts[0] below edges[0], counts[i] from edges[i - 1] up
/// to but not including edges[i], the last one from the last edge on.
struct Histogram {
  std::vector<double> edges;  ///< ascending
  std::vector<std::uint64_t> counts;
};

/// The distribution of values.
struct Distribution {
  std::uint64_t count = 0;      ///< of values that are not NaN
  std::uint64_t undefined = 0;  ///< of NaNs
  /// If count > 0: the extremes, the places of the first values that are so small or large, and the
  /// mean.
  double least = 0, largest = 0, mean = 0;
  std::uint64_t least_at = 0, largest_at = 0;
  /// percentiles[i]: the least value such that at least kPercents[i] percent of all values are not
  /// greater (nearest rank).
  std::array<double, kPercents.size()> percentiles{};
  Histogram histogram;
};

/// Returns the distribution of values with a histogram of the given edges, in time linear in their
/// number and in parallel; reorders the values. The result does not depend on the number of
/// threads. Throws Cancelled.
Distribution distribution_of(std::span<double> values, std::span<const double> edges);

/// Returns the sum of the values that are not NaN, in parallel; it does not depend on the number of
/// threads.
double sum_of(std::span<const double> values);

}  // namespace hiac
