#include "hiac/mesh/parts/used_nodes.hpp"

namespace hiac {

std::vector<NodeId> renumber_used_nodes(std::span<NodeId> nodes, std::size_t count) {
  std::vector<bool> is_used(count, false);
  for (const NodeId node : nodes) is_used[node] = true;
  std::vector<NodeId> used;
  for (std::size_t node = 0; node < count; ++node)
    if (is_used[node]) used.push_back(static_cast<NodeId>(node));
  if (used.size() == count) return used;  // the numbers stay as they are
  std::vector<NodeId> number(count);
  for (std::size_t i = 0; i < used.size(); ++i) number[used[i]] = static_cast<NodeId>(i);
  for (NodeId& node : nodes) node = number[node];
  return used;
}

}  // namespace hiac
