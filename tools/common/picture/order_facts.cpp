#include "tools/common/picture/order_facts.hpp"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

namespace hiac::tools {

nlohmann::ordered_json order_facts(const VisibilityOrder& order) {
  std::uint64_t in_groups = 0, largest = 1;
  for (const CellGroup& group : order.groups) {
    in_groups += group.count;
    largest = std::max<std::uint64_t>(largest, group.count);
  }
  return {{"algorithm", order.algorithm},
          {"cells", order.cells.size()},
          {"groups_of_several_cells", order.groups.size()},
          {"largest_group", largest},
          {"cells_in_groups", in_groups}};
}

nlohmann::ordered_json order_facts(const MeshOrder& order) {
  nlohmann::ordered_json facts = order_facts(order.record.order);
  if (!order.statistics) return facts;
  const OrderStatistics& s = *order.statistics;
  facts.update({{"shared_faces", s.shared_faces},
                {"unmatched_faces", s.unmatched_faces},
                {"arrows_one_way", s.shared_faces - s.edge_on - s.both_ways},
                {"edge_on", s.edge_on},
                {"arrows_both_ways", s.both_ways},
                {"convex", s.convex},
                {"overlapping_pairs", order.overlapping_pairs},
                {"gap_pairs", s.gap_pairs},
                {"gap_arrows", s.gap_arrows},
                {"planarity", order.planarity},
                {"seconds",
                 {{"relation", s.relation_seconds},
                  {"gaps", s.gap_seconds},
                  {"components", s.component_seconds}}}});
  return facts;
}

std::string order_line(const MeshOrder& order) {
  if (!order.statistics) return "";
  const OrderStatistics& s = *order.statistics;
  return fmt::format(
      "order: {} shared and {} unmatched faces; {} of {} cells in {} groups, "
      "the largest of {}; planarity {:g}",
      s.shared_faces, s.unmatched_faces, s.cells_in_groups, order.record.order.cells.size(),
      order.record.order.groups.size(), s.largest_group, order.planarity);
}

}  // namespace hiac::tools
