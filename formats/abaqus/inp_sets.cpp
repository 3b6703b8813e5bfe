#include "formats/abaqus/inp_sets.hpp"

#include <algorithm>
#include <set>
#include <unordered_set>

#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats::abaqus {

void add_number(std::int64_t number, std::vector<NumberRange>& ranges) {
  const bool continues = !ranges.empty() && ranges.back().step == 1 &&
                         number > ranges.back().last && number - 1 == ranges.back().last;
  if (continues)
    ranges.back().last = number;
  else
    ranges.push_back({number, number, 1});
}

NumberSet& set_named(NumberSets& sets, const std::string& name) {
  NumberSet& set = sets[upper(name)];
  if (set.name.empty()) set.name = name;
  return set;
}

void add_ranges(const std::vector<NumberRange>& ranges, NumberSet& set, std::size_t copied) {
  constexpr std::size_t kFew = 1000;
  set.ranges.insert(set.ranges.end(), ranges.begin(), ranges.end());
  set.copied += copied;
  if (set.copied < set.ranges.size() / 2 + kFew) return;
  std::set<NumberRange> seen;
  std::erase_if(set.ranges, [&](const NumberRange& range) { return !seen.insert(range).second; });
  set.copied = 0;
}

void Places::follow(const std::vector<std::int64_t>& numbers) {
  for (; known_ < numbers.size(); ++known_) places_[numbers[known_]] = known_;
}

std::optional<std::size_t> Places::find(std::int64_t number) const {
  const auto found = places_.find(number);
  return found == places_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::int64_t> members_of(const NumberSet& set, const Places& places,
                                     const std::vector<std::int64_t>& numbers,
                                     std::size_t& looked_at) {
  std::vector<std::int64_t> members;
  std::unordered_set<std::int64_t> seen;
  const auto add = [&](std::int64_t number) {
    if (seen.insert(number).second) members.push_back(number);
  };
  for (const NumberRange& range : set.ranges) {
    const auto wide =
        static_cast<std::uint64_t>(range.last) - static_cast<std::uint64_t>(range.first);
    const std::uint64_t steps = wide / static_cast<std::uint64_t>(range.step);
    looked_at += static_cast<std::size_t>(std::min<std::uint64_t>(steps, numbers.size())) + 1;
    if (steps > numbers.size()) {
      // a range may be far longer than the mesh
      std::vector<std::int64_t> inside;
      for (const std::int64_t number : numbers)
        if (number >= range.first && number <= range.last &&
            (number - range.first) % range.step == 0)
          inside.push_back(number);
      std::sort(inside.begin(), inside.end());
      for (const std::int64_t number : inside) add(number);
      continue;
    }
    for (std::uint64_t i = 0; i <= steps; ++i) {
      const std::int64_t number = range.first + static_cast<std::int64_t>(i) * range.step;
      if (places.find(number)) add(number);
    }
  }
  if (!set.unsorted) std::sort(members.begin(), members.end());
  return members;
}

}  // namespace hiac::formats::abaqus
