#include "hiac/order/components.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace hiac {
namespace {

// The relation as a graph: arrows run from a cell to the cells behind it.
struct Graph {
  const BehindRelation& relation;
  std::span<const CellId> neighbors;

  [[nodiscard]] std::size_t cell_count() const { return relation.face_offset.size() - 1; }
  [[nodiscard]] bool cell_first(std::uint64_t face) const {
    return (relation.arrows[face] & kCellFirst) != 0;
  }
  [[nodiscard]] bool neighbor_first(std::uint64_t face) const {
    return (relation.arrows[face] & kNeighborFirst) != 0;
  }
};

// Appends to `order` every cell that no cycle keeps from being output. Of `waiting` remains, for
// each cell, the number of cells that must come before it and have not: 0 for those appended.
void peel(const Graph& graph, std::vector<std::uint8_t>& waiting, std::vector<CellId>& order) {
  const auto& offset = graph.relation.face_offset;
  std::vector<CellId> ready;
  for (std::size_t cell = graph.cell_count(); cell-- > 0;) {
    std::uint8_t before = 0;
    for (std::uint64_t face = offset[cell]; face < offset[cell + 1]; ++face)
      before = static_cast<std::uint8_t>(before + (graph.neighbor_first(face) ? 1 : 0));
    waiting[cell] = before;
    if (before == 0) ready.push_back(static_cast<CellId>(cell));
  }
  // last in, first out: consecutive cells of the order are neighbours, which caches reward
  while (!ready.empty()) {
    const CellId cell = ready.back();
    ready.pop_back();
    order.push_back(cell);
    for (std::uint64_t face = offset[cell]; face < offset[cell + 1]; ++face)
      if (graph.cell_first(face) && --waiting[graph.neighbors[face]] == 0)
        ready.push_back(graph.neighbors[face]);
  }
}

// Tarjan's algorithm on the cells with waiting > 0, without recursion. Components come out last
// first, each as a run of `reversed`; `ends` holds where each run ends.
class Tarjan {
 public:
  Tarjan(const Graph& graph, const std::vector<std::uint8_t>& waiting)
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
    path_.emplace_back(cell, graph_.relation.face_offset[cell]);
  }

  void visit(CellId root) {
    open(root);
    while (!path_.empty()) {
      auto& [cell, face] = path_.back();
      if (face == graph_.relation.face_offset[cell + 1]) {
        close(cell);
        continue;
      }
      const std::uint64_t crossed = face++;
      if (!graph_.cell_first(crossed)) continue;
      const CellId behind = graph_.neighbors[crossed];
      if (waiting_[behind] == 0 || index_[behind] == kClosed) continue;
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
  const std::vector<std::uint8_t>& waiting_;
  std::vector<std::uint32_t> index_, low_;
  std::vector<CellId> stack_;
  std::vector<std::pair<CellId, std::uint64_t>> path_;
  std::uint32_t next_index_ = 0;
};

}  // namespace

VisibilityOrder order_of_components(const BehindRelation& relation,
                                    std::span<const CellId> neighbors) {
  const Graph graph{relation, neighbors};
  std::vector<std::uint8_t> waiting(graph.cell_count());
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
