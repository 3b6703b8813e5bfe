#include "formats/common/mesh/used_points.hpp"

#include <fmt/format.h>

namespace hiac::formats {

UsedPoints use_points(std::vector<NodeId>& nodes, std::size_t point_count,
                      std::vector<std::string>& notes) {
  std::vector<bool> used(point_count, false);
  for (const NodeId node : nodes) used[node] = true;
  UsedPoints result;
  for (std::size_t p = 0; p < point_count; ++p)
    if (used[p]) result.chosen.push_back(static_cast<std::uint32_t>(p));
  if (result.chosen.size() == point_count) {
    result.chosen = {};
    return result;
  }
  result.all = false;
  notes.push_back(fmt::format("dropped {} points that no converted cell uses",
                              point_count - result.chosen.size()));
  std::vector<NodeId> number(point_count, 0);
  for (std::size_t i = 0; i < result.chosen.size(); ++i)
    number[result.chosen[i]] = static_cast<NodeId>(i);
  for (NodeId& node : nodes) node = number[node];
  return result;
}

}  // namespace hiac::formats
