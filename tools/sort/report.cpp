#include "tools/sort/report.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "hiac/order/algorithm.hpp"

namespace hiac::tools {
namespace {

std::string row(const std::string& name, const std::string& text) {
  return fmt::format("  {:<16} {}\n", name, text);
}

std::string cells_by_kind(const ZooMesh& mesh) {
  std::array<std::uint64_t, kKindCount> counts{};
  for (const CellKind kind : mesh.kinds) ++counts[static_cast<std::size_t>(kind)];
  std::string text;
  for (std::size_t kind = 0; kind < kKindCount; ++kind)
    if (counts[kind] > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[kind],
                          kind_name(static_cast<CellKind>(kind)));
  return text;
}

std::uint64_t one_way(const OrderStatistics& s) { return s.shared_faces - s.edge_on - s.both_ways; }

// The lines of a single order.
std::string one_order(const ReportedOrder& order) {
  const OrderStatistics& s = order.statistics;
  std::string text = row("algorithm", order.algorithm);
  if (order.algorithm == algorithm_name(OrderAlgorithm::exact)) {
    text += row("shared faces", fmt::format("{}: {} crossed one way, {} edge-on, {} both ways",
                                            s.shared_faces, one_way(s), s.edge_on, s.both_ways));
    text += row("unmatched faces",
                fmt::format("{}{}", s.unmatched_faces,
                            s.convex ? ", the boundary of a convex body: no gaps" : ""));
    text += row("gap arrows", fmt::format("{} from {} pairs of faces", s.gap_arrows, s.gap_pairs));
    text +=
        row("order's seconds", fmt::format("relation {:.3f}, gaps {:.3f}, components {:.3f}",
                                           s.relation_seconds, s.gap_seconds, s.component_seconds));
  }
  return text +
         row("groups", fmt::format("{} of several cells, {} cells in them, {} in the largest",
                                   order.groups, s.cells_in_groups, s.largest_group));
}

std::string many_orders(const std::vector<ReportedOrder>& orders) {
  std::string text = fmt::format("  {:>6} {:>12} {:>10} {:>10} {:>10} {:>8} {:>8} {:>9} {:>9}\n",
                                 "frame", "one way", "edge-on", "both ways", "gap arrows", "groups",
                                 "largest", "in groups", "seconds");
  for (const ReportedOrder& order : orders) {
    const OrderStatistics& s = order.statistics;
    text += fmt::format("  {:>6} {:>12} {:>10} {:>10} {:>10} {:>8} {:>8} {:>9} {:>9.3f}\n",
                        order.frame, one_way(s), s.edge_on, s.both_ways, s.gap_arrows, order.groups,
                        s.largest_group, s.cells_in_groups, order.seconds);
  }
  return text;
}

}  // namespace

std::string statistics_table(const ZooMesh& mesh, const std::vector<ReportedOrder>& orders,
                             const nlohmann::ordered_json& seconds, std::uint64_t peak_bytes) {
  std::string text = row("cells", fmt::format("{} ({})", mesh.cell_count(), cells_by_kind(mesh)));
  text += orders.size() == 1 ? one_order(orders.front()) : many_orders(orders);
  std::string stages;
  for (const auto& [stage, value] : seconds.items())
    stages += fmt::format("{}{} {:.3f}", stages.empty() ? "" : ", ", stage, value.get<double>());
  text += row("seconds", stages);
  const double cells = static_cast<double>(std::max<std::size_t>(mesh.cell_count(), 1));
  return text + row("memory", fmt::format("{:.1f} MiB at its peak, {:.0f} bytes a cell",
                                          static_cast<double>(peak_bytes) / (1 << 20),
                                          static_cast<double>(peak_bytes) / cells));
}

std::string check_text(const OrderCheck& check, const VisibilityOrder& order) {
  const std::string asked = check.pairs > 0 || check.arrows == 0
                                ? fmt::format("{} pairs of cells", check.pairs)
                                : fmt::format("{} arrows of the relation", check.arrows);
  if (check.right()) {
    std::string text = fmt::format("verified: {} and {} groups", asked, check.groups);
    if (check.left_out > 0)
      text += fmt::format(
          "; {} cells without an inside or not convex only by their arrows of the relation",
          check.left_out);
    if (check.in_part > 0)
      text += fmt::format(
          "; {} cells with curved or warped faces without what is nearer to a face than twice what "
          "it deviates from a plane",
          check.in_part);
    return text;
  }
  std::string text = "the order is wrong: ";
  for (const auto& [first, second] : check.wrong)
    text +=
        fmt::format("{}cell {} comes before {} that a ray meets first",
                    first == check.wrong[0].first && second == check.wrong[0].second ? "" : ", ",
                    first, second);
  if (check.wrong_count > check.wrong.size())
    text += fmt::format(" and {} more", check.wrong_count - check.wrong.size());
  for (const CellGroup& group : check.loose)
    text += fmt::format("{}the group of {} cells from place {} on (cell {}) is no cycle",
                        &group == &check.loose.front() && check.wrong.empty() ? "" : ", ",
                        group.count, group.first, order.cells[group.first]);
  return text + fmt::format(" ({} and {} groups checked)", asked, check.groups);
}

nlohmann::ordered_json check_facts(const OrderCheck& check) {
  return {{"right", check.right()},
          {"pairs", check.pairs},
          {"cells_left_out", check.left_out},
          {"cells_in_part", check.in_part},
          {"arrows", check.arrows},
          {"groups", check.groups},
          {"wrong_pairs", check.wrong},
          {"wrong_pair_count", check.wrong_count},
          {"groups_without_cycle", check.loose.size()}};
}

}  // namespace hiac::tools
