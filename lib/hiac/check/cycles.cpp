#include "hiac/check/cycles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

#include "hiac/order/behind_relation.hpp"
#include "hiac/order/components.hpp"
#include "hiac/order/gaps/gap_relation.hpp"

namespace hiac {
namespace {

// The relation among the cells of one group.
class GroupGraph {
 public:
  GroupGraph(const OrderBasis& basis, const BehindRelation& relation, const GapRelation& gaps,
             std::span<const CellId> cells)
      : basis_(basis), relation_(relation), gaps_(gaps), cells_(cells) {
    for (std::uint32_t i = 0; i < cells.size(); ++i) place_.emplace(cells[i], i);
  }

  // Returns a shortest path from the first cell back to itself, by breadth-first search.
  [[nodiscard]] std::vector<CycleCell> cycle() const {
    constexpr std::uint32_t kNone = ~std::uint32_t{0};
    std::vector<std::uint32_t> from(cells_.size(), kNone), queue{0};
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const std::uint32_t at = queue[head];
      bool closed = false;
      for_each_behind(cells_[at], [&](CellId behind) {
        const auto found = place_.find(behind);
        if (found == place_.end()) return;
        closed = closed || found->second == 0;
        if (found->second == 0 || from[found->second] != kNone) return;
        from[found->second] = at;
        queue.push_back(found->second);
      });
      if (closed) return told(from, at);
    }
    return {};
  }

 private:
  template <typename Visit>
  void for_each_behind(CellId cell, const Visit& visit) const {
    const std::uint64_t first = basis_.faces.first(cell);
    for (std::uint32_t f = 0; f < basis_.faces.count(cell); ++f)
      if ((relation_.of_cell[cell].across(f) & kCellFirst) != 0)
        visit(basis_.adjacency.neighbors[first + f]);
    for (const CellId behind : gaps_.behind_cell(cell)) visit(behind);
  }

  [[nodiscard]] std::vector<CycleCell> told(const std::vector<std::uint32_t>& from,
                                            std::uint32_t last) const {
    std::vector<CellId> way;
    for (std::uint32_t at = last; at != 0; at = from[at]) way.push_back(cells_[at]);
    way.push_back(cells_[0]);
    std::ranges::reverse(way);
    std::vector<CycleCell> cycle;
    for (std::size_t i = 0; i < way.size(); ++i)
      cycle.push_back(step(way[i], way[(i + 1) % way.size()]));
    return cycle;
  }

  [[nodiscard]] CycleCell step(CellId cell, CellId next) const {
    const ZooMesh& mesh = *basis_.mesh;
    const auto nodes = mesh.cell_nodes(cell);
    const auto faces = topology_of(mesh.kinds[cell]).faces;
    const std::uint64_t first = basis_.faces.first(cell);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const FaceArrows arrows = relation_.of_cell[cell].across(f);
      if (basis_.adjacency.neighbors[first + f] != next || (arrows & kCellFirst) == 0) continue;
      const CycleStep how = arrows == kBothWays ? CycleStep::both_ways : CycleStep::face;
      return {cell, how, middle(nodes, std::span(faces[f].corners).first(faces[f].corner_count))};
    }
    constexpr std::array<std::uint8_t, 8> kCorners{0, 1, 2, 3, 4, 5, 6, 7};
    return {cell, CycleStep::gap,
            middle(nodes, std::span(kCorners).first(corner_count(mesh.kinds[cell])))};
  }

  [[nodiscard]] std::array<double, 3> middle(std::span<const NodeId> nodes,
                                             std::span<const std::uint8_t> corners) const {
    std::array<double, 3> sum{};
    for (const std::uint8_t corner : corners)
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += basis_.mesh->position(nodes[corner])[c] / static_cast<double>(corners.size());
    return sum;
  }

  const OrderBasis& basis_;
  const BehindRelation& relation_;
  const GapRelation& gaps_;
  std::span<const CellId> cells_;
  std::unordered_map<CellId, std::uint32_t> place_;
};

}  // namespace

std::vector<VisibilityGroup> find_cycles(const OrderBasis& basis, const View& view,
                                         double planarity) {
  const BehindRelation relation = shared_face_relation(basis, view, planarity);
  const GapRelation gaps = gap_relation(basis, view, planarity);
  const VisibilityOrder order =
      order_of_components(relation, basis.faces, basis.adjacency.neighbors.view(), gaps);
  std::vector<VisibilityGroup> groups;
  for (const CellGroup& group : order.groups) {
    const auto cells = order.cells.view().subspan(group.first, group.count);
    groups.push_back(
        {{cells.begin(), cells.end()}, GroupGraph(basis, relation, gaps, cells).cycle()});
  }
  return groups;
}

std::vector<View> spread_views(std::size_t count) {
  std::vector<View> views;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
    const double around = std::sqrt(1 - z * z);
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / std::numbers::phi;
    views.push_back({false, {}, {around * std::cos(angle), around * std::sin(angle), z}});
  }
  return views;
}

}  // namespace hiac
