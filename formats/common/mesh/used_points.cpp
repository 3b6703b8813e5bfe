#include "formats/common/mesh/used_points.hpp"

#include <fmt/format.h>

#include "hiac/mesh/parts/used_nodes.hpp"

namespace hiac::formats {

UsedPoints use_points(std::vector<NodeId>& nodes, std::size_t point_count,
                      std::vector<std::string>& notes) {
  UsedPoints result;
  result.chosen = renumber_used_nodes(nodes, point_count);
  if (result.chosen.size() == point_count) {
    result.chosen = {};
    return result;
  }
  result.all = false;
  notes.push_back(fmt::format("dropped {} points that no converted cell uses",
                              point_count - result.chosen.size()));
  return result;
}

}  // namespace hiac::formats
