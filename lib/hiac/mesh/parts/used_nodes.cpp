#include "hiac/mesh/parts/used_nodes.hpp"

#include <atomic>

#include "hiac/base/parallel.hpp"

namespace hiac {

std::vector<std::uint8_t> mark_used_nodes(std::span<const NodeId> nodes, std::size_t count) {
  constexpr std::size_t kGrain = 1 << 16;
  std::vector<std::uint8_t> is_used(count, 0);
  parallel_for(nodes.size(), kGrain, [&](IndexRange range) {
    for (const NodeId node : nodes.subspan(range.begin, range.end - range.begin))
      std::atomic_ref(is_used[node]).store(1, std::memory_order_relaxed);
  });
  return is_used;
}

std::vector<NodeId> renumber_used_nodes(std::span<NodeId> nodes, std::size_t count) {
  const std::vector<std::uint8_t> is_used = mark_used_nodes(nodes, count);
  std::vector<NodeId> used;
  for (std::size_t node = 0; node < count; ++node)
    if (is_used[node] != 0) used.push_back(static_cast<NodeId>(node));
  if (used.size() == count) return used;  // the numbers stay as they are
  std::vector<NodeId> number(count);
  for (std::size_t i = 0; i < used.size(); ++i) number[used[i]] = static_cast<NodeId>(i);
  for (NodeId& node : nodes) node = number[node];
  return used;
}

}  // namespace hiac
