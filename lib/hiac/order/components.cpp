#include "hiac/order/components.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace hiac {
namespace {

// The relation as a graph: arrows run from a cell to the cells behind it. A cell's arrows are
// numbered: first its faces', then those across gaps.
class Graph {
 public:
  Graph(const BehindRelation& relation, std::span<const CellId> neighbors,
        std::span<const GapArrow> gap_arrows)
      : relation_(relation), neighbors_(neighbors), gap_arrows_(gap_arrows) {
    if (gap_arrows.empty()) return;
    gap_start_.assign(cell_count() + 1, 0);
    for (const GapArrow& arrow : gap_arrows) ++gap_start_[arrow.front + 1];
    for (std::size_t cell = 0; cell < cell_count(); ++cell)
      gap_start_[cell + 1] += gap_start_[cell];
  }

  [[nodiscard]] std::size_t cell_count() const { return relation_.face_offset.size() - 1; }

  // The number of arrows that end in each cell.
  [[nodiscard]] std::vector<std::uint32_t> arrows_into() const {
    std::vector<std::uint32_t> count(cell_count(), 0);
    const auto& offset = relation_.face_offset;
    for (std::size_t cell = 0; cell < cell_count(); ++cell)
      for (std::uint64_t face = offset[cell]; face < offset[cell + 1]; ++face)
        count[cell] += (relation_.arrows[face] & kNeighborFirst) != 0 ? 1U : 0U;
    for (const GapArrow& arrow : gap_arrows_) ++count[arrow.behind];
    return count;
  }

  // How many numbers a cell's arrows take.
  [[nodiscard]] std::uint32_t arrow_slots(CellId cell) const {
    return face_count(cell) + gap_count(cell);
  }
  // The cell behind arrow number `slot` of a cell, or kNoCell when that number has no arrow.
  [[nodiscard]] CellId behind(CellId cell, std::uint32_t slot) const {
    if (slot >= face_count(cell))
      return gap_arrows_[gap_start_[cell] + slot - face_count(cell)].behind;
    const std::uint64_t face = relation_.face_offset[cell] + slot;
    return (relation_.arrows[face] & kCellFirst) != 0 ? neighbors_[face] : kNoCell;
  }

 private:
  [[nodiscard]] std::uint32_t face_count(CellId cell) const {
    return static_cast<std::uint32_t>(relation_.face_offset[cell + 1] -
                                      relation_.face_offset[cell]);
  }
  [[nodiscard]] std::uint32_t gap_count(CellId cell) const {
    return gap_start_.empty() ? 0 : gap_start_[cell + 1] - gap_start_[cell];
  }

  const BehindRelation& relation_;
  std::span<const CellId> neighbors_;
  std::span<const GapArrow> gap_arrows_;
  std::vector<std::uint32_t> gap_start_;
};

// Appends to `order` every cell that no cycle keeps from being output. Of `waiting` remains, for
// each cell, the number of cells that must come before it and have not: 0 for those appended.
void peel(const Graph& graph, std::vector<std::uint32_t>& waiting, std::vector<CellId>& order) {
  std::vector<CellId> ready;
  for (std::size_t cell = graph.cell_count(); cell-- > 0;)
    if (waiting[cell] == 0) ready.push_back(static_cast<CellId>(cell));
  // last in, first out: consecutive cells of the order are neighbours, which caches reward
  while (!ready.empty()) {
    const CellId cell = ready.back();
    ready.pop_back();
    order.push_back(cell);
    for (std::uint32_t slot = 0; slot < graph.arrow_slots(cell); ++slot) {
      const CellId behind = graph.behind(cell, slot);
      if (behind != kNoCell && --waiting[behind] == 0) ready.push_back(behind);
    }
  }
}

// Tarjan's algorithm on the cells with waiting > 0, without recursion. Components come out last
// first, each as a run of `reversed`; `ends` holds where each run ends.
class Tarjan {
 public:
  Tarjan(const Graph& graph, const std::vector<std::uint32_t>& waiting)
      : graph_(graph), waiting_(waiting), index_(waiting.size(), kUnseen), low_(waiting.size(), 0) {
    for (std::size_t cell = 0; cell < waiting.size(); ++cell)
      if (waiting[cell] > 0 && index_[cell] == kUnseen) visit(static_cast<CellId>(cell));
  }

  std::vector<CellId> reversed;
  std::vector<std::size_t> ends;

 private:
  static constexpr std::uint32_t kUnseen = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t kClosed = kUnseen - 1;  // its component is complete

  void open(CellId cell) {
    index_[cell] = low_[cell] = next_index_++;
    stack_.push_back(cell);
    path_.emplace_back(cell, 0);
  }

  void visit(CellId root) {
    open(root);
    while (!path_.empty()) {
      auto& [cell, slot] = path_.back();
      if (slot == graph_.arrow_slots(cell)) {
        close(cell);
        continue;
      }
      const CellId behind = graph_.behind(cell, slot++);
      if (behind == kNoCell || waiting_[behind] == 0 || index_[behind] == kClosed) continue;
      if (index_[behind] == kUnseen)
        open(behind);
      else
        low_[cell] = std::min(low_[cell], index_[behind]);
    }
  }

  void close(CellId cell) {
    path_.pop_back();
    if (!path_.empty()) low_[path_.back().first] = std::min(low_[path_.back().first], low_[cell]);
    if (low_[cell] != index_[cell]) return;
    CellId member = kNoCell;
    do {
      member = stack_.back();
      stack_.pop_back();
      index_[member] = kClosed;
      reversed.push_back(member);
    } while (member != cell);
    ends.push_back(reversed.size());
  }

  const Graph& graph_;
  const std::vector<std::uint32_t>& waiting_;
  std::vector<std::uint32_t> index_, low_;
  std::vector<CellId> stack_;
  std::vector<std::pair<CellId, std::uint32_t>> path_;  // cell, its next arrow
  std::uint32_t next_index_ = 0;
};

}  // namespace

VisibilityOrder order_of_components(const BehindRelation& relation,
                                    std::span<const CellId> neighbors,
                                    std::span<const GapArrow> gap_arrows) {
  const Graph graph(relation, neighbors, gap_arrows);
  std::vector<std::uint32_t> waiting = graph.arrows_into();
  std::vector<CellId> order;
  order.reserve(graph.cell_count());
  peel(graph, waiting, order);
  std::vector<CellGroup> groups;
  if (order.size() < graph.cell_count()) {
    const Tarjan tarjan(graph, waiting);
    for (std::size_t c = tarjan.ends.size(); c-- > 0;) {
      const std::size_t begin = c == 0 ? 0 : tarjan.ends[c - 1], end = tarjan.ends[c];
      const auto first = static_cast<std::uint32_t>(order.size());
      order.insert(order.end(), tarjan.reversed.begin() + static_cast<std::ptrdiff_t>(begin),
                   tarjan.reversed.begin() + static_cast<std::ptrdiff_t>(end));
      if (end - begin < 2) continue;
      std::sort(order.begin() + first, order.end());
      groups.push_back({first, static_cast<std::uint32_t>(end - begin)});
    }
  }
  return {std::move(order), std::move(groups), "exact"};
}

}  // namespace hiac
