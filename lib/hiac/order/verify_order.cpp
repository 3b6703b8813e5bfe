#include "hiac/order/verify_order.hpp"

#include <algorithm>
#include <mutex>
#include <optional>

#include "hiac/base/parallel.hpp"
#include "hiac/order/behind_relation.hpp"
#include "hiac/order/gaps/gap_relation.hpp"
#include "hiac/order/gaps/ray_precedence.hpp"

namespace hiac {
namespace {

// Returns, for every cell, the place in the order of the first cell of its group.
std::vector<std::uint32_t> group_starts(const VisibilityOrder& order) {
  std::vector<std::uint32_t> start(order.cells.size());
  for (std::uint32_t at = 0; at < start.size(); ++at) start[order.cells[at]] = at;
  for (const CellGroup& group : order.groups)
    for (std::uint32_t k = 0; k < group.count; ++k)
      start[order.cells[group.first + k]] = group.first;
  return start;
}

// Wrong pairs, each with the place of its first cell's group, by which they are sorted.
struct WrongPairs {
  std::vector<std::pair<std::uint32_t, std::pair<CellId, CellId>>> found;

  void put_into(OrderCheck& check) {
    check.wrong_count = found.size();
    std::ranges::sort(found);
    found.resize(std::min(found.size(), kMostWrongPairs));
    for (const auto& [place, pair] : found) check.wrong.push_back(pair);
  }
};

using HullCells = std::vector<std::optional<HullCell>>;

HullCells hull_cells(const ZooMesh& mesh, const View& view, double inset) {
  HullCells hulls(mesh.cell_count());
  parallel_for(mesh.cell_count(), 64, [&](IndexRange range) {
    for (std::size_t cell = range.begin; cell < range.end; ++cell)
      hulls[cell] = hull_cell(mesh, static_cast<CellId>(cell), view, inset);
  });
  return hulls;
}

// The arrows between cells of the same group, as a list of targets for each cell.
class InnerArrows {
 public:
  explicit InnerArrows(std::size_t cells) : start_(cells + 1, 0) {}

  void add(CellId from, CellId to) { arrows_.emplace_back(from, to); }
  void close() {
    std::ranges::sort(arrows_);
    for (const auto& arrow : arrows_) ++start_[arrow.first + 1];
    for (std::size_t cell = 0; cell + 1 < start_.size(); ++cell) start_[cell + 1] += start_[cell];
  }

  // Returns the number of cells that can be reached from a cell, itself included.
  [[nodiscard]] std::size_t reached_from(CellId cell, std::vector<std::uint8_t>& seen) const {
    std::vector<CellId> all{cell};
    seen[cell] = 1;
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t k = start_[all[i]]; k < start_[all[i] + 1]; ++k)
        if (const CellId to = arrows_[k].second; seen[to] == 0) {
          seen[to] = 1;
          all.push_back(to);
        }
    return all.size();
  }

 private:
  std::vector<std::pair<CellId, CellId>> arrows_;
  std::vector<std::size_t> start_;
};

void judge_groups_by_arrows(const VisibilityOrder& order, const InnerArrows& forward,
                            const InnerArrows& backward, OrderCheck& check) {
  std::vector<std::uint8_t> seen(order.cells.size(), 0), seen_back = seen;
  for (const CellGroup& group : order.groups) {
    ++check.groups;
    const CellId first = order.cells[group.first];
    if (forward.reached_from(first, seen) < group.count ||
        backward.reached_from(first, seen_back) < group.count)
      check.loose.push_back(group);
  }
}

// Does the work of verify_pairs; `left_out` tells for every cell whether it was left out.
OrderCheck check_pairs(const ZooMesh& mesh, const View& view, const VisibilityOrder& order,
                       double planarity, std::vector<std::uint8_t>& left_out, WrongPairs& wrong) {
  OrderCheck check;
  const HullCells hulls = hull_cells(mesh, view, 2 * planarity);
  const auto start = group_starts(order);
  std::mutex joining;
  // by place in the order, so that the pairs of a range have similar depths
  parallel_for(order.cells.size(), 8, [&](IndexRange range) {
    WrongPairs here;
    std::uint64_t pairs = 0;
    for (std::size_t at = range.begin; at < range.end; ++at) {
      const CellId front = order.cells[at];
      for (std::size_t later = at + 1; later < order.cells.size(); ++later) {
        const CellId behind = order.cells[later];
        if (start[front] == start[behind] || !hulls[front] || !hulls[behind]) continue;
        ++pairs;
        if (met_first(*hulls[behind], *hulls[front], view))
          here.found.push_back({start[front], {front, behind}});
      }
    }
    const std::scoped_lock lock(joining);
    check.pairs += pairs;
    wrong.found.insert(wrong.found.end(), here.found.begin(), here.found.end());
  });
  left_out.assign(hulls.size(), 0);
  for (std::size_t cell = 0; cell < hulls.size(); ++cell) {
    left_out[cell] = hulls[cell] ? 0 : 1;
    check.left_out += left_out[cell];
    check.in_part += hulls[cell] && hulls[cell]->deviation > planarity ? 1U : 0U;
  }
  return check;
}

// Does the work of verify_arrows.
OrderCheck check_arrows(const OrderBasis& basis, const View& view, const VisibilityOrder& order,
                        double planarity, WrongPairs& wrong) {
  OrderCheck check;
  const auto start = group_starts(order);
  const std::size_t cells = start.size();
  InnerArrows forward(cells), backward(cells);
  const auto follow = [&](CellId front, CellId behind) {
    ++check.arrows;
    if (start[front] > start[behind]) wrong.found.push_back({start[behind], {behind, front}});
    if (start[front] != start[behind]) return;
    forward.add(front, behind);
    backward.add(behind, front);
  };
  const BehindRelation relation = shared_face_relation(basis, view, planarity);
  const GapRelation gaps = gap_relation(basis, view, planarity);
  for (CellId cell = 0; cell < cells; ++cell) {
    for (std::size_t f = 0; f < basis.faces.count(cell); ++f)
      if ((relation.of_cell[cell].across(f) & kCellFirst) != 0)
        follow(cell, basis.adjacency.neighbors[basis.faces.first(cell) + f]);
    for (const CellId behind : gaps.behind_cell(cell)) follow(cell, behind);
  }
  forward.close();
  backward.close();
  judge_groups_by_arrows(order, forward, backward, check);
  return check;
}

}  // namespace

OrderCheck verify_pairs(const ZooMesh& mesh, const View& view, const VisibilityOrder& order,
                        double planarity) {
  std::vector<std::uint8_t> left_out;
  WrongPairs wrong;
  OrderCheck check = check_pairs(mesh, view, order, planarity, left_out, wrong);
  wrong.put_into(check);
  return check;
}

OrderCheck verify_arrows(const OrderBasis& basis, const View& view, const VisibilityOrder& order,
                         double planarity) {
  WrongPairs wrong;
  OrderCheck check = check_arrows(basis, view, order, planarity, wrong);
  wrong.put_into(check);
  return check;
}

OrderCheck verify_order(const OrderBasis& basis, const View& view, const VisibilityOrder& order,
                        double planarity) {
  WrongPairs by_arrows, wrong;
  OrderCheck check = check_arrows(basis, view, order, planarity, by_arrows);
  if (basis.mesh->cell_count() > kMostCellsForPairs) {
    by_arrows.put_into(check);
    return check;
  }
  std::vector<std::uint8_t> left_out;
  OrderCheck pairs = check_pairs(*basis.mesh, view, order, planarity, left_out, wrong);
  for (const auto& found : by_arrows.found)
    if (left_out[found.second.first] != 0 || left_out[found.second.second] != 0)
      wrong.found.push_back(found);
  wrong.put_into(pairs);
  pairs.groups = check.groups;
  pairs.loose = std::move(check.loose);
  return pairs;
}

}  // namespace hiac
