#include "formats/common/io/number_index.hpp"

#include <algorithm>

namespace hiac::formats {
namespace {

/// A table may have at most this many places per number.
constexpr std::uint64_t kTablePlaces = 8;

}  // namespace

NumberIndex::NumberIndex(std::span<const std::int64_t> numbers) : count_(numbers.size()) {
  if (numbers.empty()) return;
  low_ = numbers.front();
  for (std::size_t i = 0; consecutive_ && i < numbers.size(); ++i)
    consecutive_ = static_cast<std::uint64_t>(numbers[i]) == static_cast<std::uint64_t>(low_) + i;
  if (consecutive_) return;
  const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
  low_ = *low;
  const auto range = static_cast<std::uint64_t>(*high) - static_cast<std::uint64_t>(low_);
  if (range / kTablePlaces < numbers.size() && numbers.size() < kHole)
    build_table(numbers, range);
  else
    build_sorted(numbers);
}

void NumberIndex::build_table(std::span<const std::int64_t> numbers, std::uint64_t range) {
  table_.assign(range + 1, kHole);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::uint32_t& place =
        table_[static_cast<std::uint64_t>(numbers[i]) - static_cast<std::uint64_t>(low_)];
    if (place == kHole)
      place = static_cast<std::uint32_t>(i);
    else
      repeated_.emplace_back(i, place);
  }
}

void NumberIndex::build_sorted(std::span<const std::int64_t> numbers) {
  sorted_.reserve(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) sorted_.emplace_back(numbers[i], i);
  std::sort(sorted_.begin(), sorted_.end());
  for (std::size_t i = 1; i < sorted_.size(); ++i)
    if (sorted_[i].first == sorted_[i - 1].first)
      repeated_.emplace_back(sorted_[i].second, find_sorted(sorted_[i].first));
}

std::size_t NumberIndex::find_sorted(std::int64_t number) const {
  const auto place = std::lower_bound(sorted_.begin(), sorted_.end(), number,
                                      [](const std::pair<std::int64_t, std::size_t>& entry,
                                         std::int64_t wanted) { return entry.first < wanted; });
  return place == sorted_.end() || place->first != number ? kNone : place->second;
}

}  // namespace hiac::formats
