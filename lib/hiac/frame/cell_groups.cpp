#include "hiac/frame/cell_groups.hpp"

#include <algorithm>
#include <limits>

namespace hiac {

CellRun first_run(const VisibilityOrder& order, std::span<const std::uint32_t> ranks,
                  std::size_t most) {
  const std::uint32_t first = ranks.front();
  const auto after = std::ranges::upper_bound(order.groups, first, {}, &CellGroup::first);
  const auto before = after == order.groups.begin() ? after : after - 1;
  const bool is_group = before != after && first < before->first + before->count;
  std::uint32_t stop = std::numeric_limits<std::uint32_t>::max();
  if (is_group)
    stop = before->first + before->count;
  else if (after != order.groups.end())
    stop = after->first;
  std::size_t count = 1;
  while (count < ranks.size() && ranks[count] < stop && (is_group || count < most)) ++count;
  return {is_group, ranks.first(count)};
}

}  // namespace hiac
