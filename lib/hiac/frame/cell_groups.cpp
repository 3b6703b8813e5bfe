#include "hiac/frame/cell_groups.hpp"

#include <algorithm>
#include <limits>

namespace hiac {
namespace {

// The first group that begins after a rank.
auto group_after(const VisibilityOrder& order, std::uint32_t rank) {
  return std::upper_bound(order.groups.begin(), order.groups.end(), rank,
                          [](std::uint32_t r, const CellGroup& g) { return r < g.first; });
}

}  // namespace

const CellGroup* group_of(const VisibilityOrder& order, std::uint32_t rank) {
  const auto after = group_after(order, rank);
  if (after == order.groups.begin()) return nullptr;
  const CellGroup& group = *(after - 1);
  return rank < group.first + group.count ? &group : nullptr;
}

std::uint32_t next_group_first(const VisibilityOrder& order, std::uint32_t rank) {
  const auto after = group_after(order, rank);
  return after == order.groups.end() ? std::numeric_limits<std::uint32_t>::max() : after->first;
}

}  // namespace hiac
