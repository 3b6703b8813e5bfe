#include "hiac/check/quality/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <mutex>

#include "hiac/base/cancellation.hpp"
#include "hiac/base/parallel.hpp"

namespace hiac {
namespace {

// Sums are taken of blocks of this length, then of the blocks.
constexpr std::size_t kBlock = 1 << 14;

// What a block of values contributes.
struct Extremes {
  std::uint64_t count = 0;
  std::uint64_t least_at = 0, largest_at = 0;
};

// Adds the values [begin, end) to the counts and extremes.
void add_values(std::span<const double> values, IndexRange range, Extremes& found,
                Histogram& histogram) {
  for (std::size_t i = range.begin; i < range.end; ++i) {
    if (std::isnan(values[i])) continue;
    if (found.count == 0 || values[i] < values[found.least_at]) found.least_at = i;
    if (found.count == 0 || values[i] > values[found.largest_at]) found.largest_at = i;
    ++found.count;
    const auto above = std::ranges::upper_bound(histogram.edges, values[i]);
    ++histogram.counts[static_cast<std::size_t>(above - histogram.edges.begin())];
  }
}

// Combines the extremes of two sets of values; of equal values the first counts.
void merge(std::span<const double> values, const Extremes& part, Extremes& all) {
  if (part.count == 0) return;
  const auto precedes = [&](std::uint64_t a, std::uint64_t b, bool smaller) {
    if (values[a] == values[b]) return a < b;
    return (values[a] < values[b]) == smaller;
  };
  if (all.count == 0 || precedes(part.least_at, all.least_at, true)) all.least_at = part.least_at;
  if (all.count == 0 || precedes(part.largest_at, all.largest_at, false))
    all.largest_at = part.largest_at;
  all.count += part.count;
}

// Puts the percentiles in their places from the largest to the smallest, each time among the values
// that are left below.
void set_percentiles(std::span<double> values, Distribution& found) {
  const auto defined =
      std::ranges::partition(values, [](double value) { return !std::isnan(value); });
  auto end = defined.begin();
  for (std::size_t i = kPercents.size(); i-- > 0;) {
    check_cancelled();
    const std::uint64_t rank = (found.count * kPercents[i] + 99) / 100;  // from 1
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(std::max<std::uint64_t>(rank, 1)) - 1;
    if (at < end) {
      std::nth_element(values.begin(), at, end);
      end = at;
    }
    found.percentiles[i] = *at;
  }
}

}  // namespace

double sum_of(std::span<const double> values) {
  std::vector<double> blocks((values.size() + kBlock - 1) / kBlock);
  parallel_for(blocks.size(), 1, [&](IndexRange range) {
    for (std::size_t b = range.begin; b < range.end; ++b)
      for (std::size_t i = b * kBlock; i < std::min(values.size(), (b + 1) * kBlock); ++i)
        if (!std::isnan(values[i])) blocks[b] += values[i];
  });
  double sum = 0;
  for (const double block : blocks) sum += block;
  return sum;
}

Distribution distribution_of(std::span<double> values, std::span<const double> edges) {
  Distribution found;
  found.histogram.edges.assign(edges.begin(), edges.end());
  found.histogram.counts.resize(edges.size() + 1);
  Extremes all;
  std::mutex joining;
  parallel_for(values.size(), kBlock, [&](IndexRange range) {
    Extremes part;
    Histogram histogram{found.histogram.edges, std::vector<std::uint64_t>(edges.size() + 1)};
    add_values(values, range, part, histogram);
    const std::scoped_lock lock(joining);
    merge(values, part, all);
    for (std::size_t i = 0; i < histogram.counts.size(); ++i)
      found.histogram.counts[i] += histogram.counts[i];
  });
  found.count = all.count;
  found.undefined = values.size() - all.count;
  if (all.count == 0) return found;
  found.least = values[all.least_at], found.least_at = all.least_at;
  found.largest = values[all.largest_at], found.largest_at = all.largest_at;
  found.mean = sum_of(values) / static_cast<double>(all.count);
  set_percentiles(values, found);
  return found;
}

}  // namespace hiac
