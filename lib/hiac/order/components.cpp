#include "hiac/order/components.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>
#include <vector>

#include "hiac/base/cancellation.hpp"
#include "hiac/base/large_pages.hpp"
#include "hiac/base/parallel.hpp"

namespace hiac {
namespace {

constexpr std::size_t kComponentsGrain = std::size_t{1} << 16;

// The relation as a graph: arrows run from a cell to the cells behind it, across its faces and
// across gaps.
class Graph {
 public:
  Graph(const BehindRelation& relation, const FaceNumbering& numbering,
        std::span<const CellId> neighbors, const GapRelation& gaps)
      : relation_(relation), numbering_(numbering), neighbors_(neighbors), gaps_(gaps) {}

  [[nodiscard]] std::size_t cell_count() const { return relation_.of_cell.size(); }
  [[nodiscard]] bool has_gaps() const { return !gaps_.behind.empty(); }

  // The faces of a cell with a cell behind them, and the faces with a cell in front; bit f: face f.
  [[nodiscard]] unsigned faces_behind(CellId cell) const {
    return relation_.of_cell[cell].cell_first;
  }
  [[nodiscard]] unsigned faces_before(CellId cell) const {
    return relation_.of_cell[cell].neighbor_first;
  }
  [[nodiscard]] CellId neighbor(CellId cell, unsigned face) const {
    return neighbors_[numbering_.first(cell) + face];
  }
  void fetch_neighbors(CellId cell) const {
    __builtin_prefetch(&neighbors_[numbering_.first(cell)]);
  }
  // The cells behind a cell across gaps.
  [[nodiscard]] std::span<const CellId> gaps_behind(CellId cell) const {
    return gaps_.behind_cell(cell);
  }
  // The number of arrows across gaps into each cell.
  [[nodiscard]] std::vector<std::uint32_t> gaps_into() const {
    std::vector<std::uint32_t> count(has_gaps() ? cell_count() : 0, 0);
    for (const CellId behind : gaps_.behind) ++count[behind];
    return count;
  }

  // The arrows of a cell are numbered, first those across its faces, then those across gaps.
  // behind() returns the cell behind arrow number `slot`, or kNoCell if that number has no arrow.
  [[nodiscard]] std::uint32_t arrow_slots(CellId cell) const {
    return numbering_.count(cell) + static_cast<std::uint32_t>(gaps_behind(cell).size());
  }
  [[nodiscard]] CellId behind(CellId cell, std::uint32_t slot) const {
    const std::uint32_t faces = numbering_.count(cell);
    if (slot >= faces) return gaps_behind(cell)[slot - faces];
    return (faces_behind(cell) >> slot & 1U) != 0 ? neighbor(cell, slot) : kNoCell;
  }

 private:
  const BehindRelation& relation_;
  const FaceNumbering& numbering_;
  std::span<const CellId> neighbors_;
  const GapRelation& gaps_;
};

// What peeling stores for a cell: two bytes, so that many cells share a cache line.
struct Waiting {
  std::uint8_t faces_behind;
  // The number of faces whose cell in front has not been output yet, plus one while arrows across
  // gaps remain from such cells.
  std::uint8_t for_cells;
};

// Returns what every cell waits for at first. `gaps`: the number of arrows across gaps into each
// cell; empty if there are none.
std::vector<Waiting> all_waiting(const Graph& graph, std::span<const std::uint32_t> gaps) {
  auto waiting = large_vector<Waiting>(graph.cell_count());
  parallel_for(waiting.size(), kComponentsGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto cell = static_cast<CellId>(i);
      const unsigned cells =
          count_faces(graph.faces_before(cell)) + (!gaps.empty() && gaps[i] > 0 ? 1U : 0U);
      waiting[i] = {static_cast<std::uint8_t>(graph.faces_behind(cell)),
                    static_cast<std::uint8_t>(cells)};
    }
  });
  return waiting;
}

// Appends to `order` all cells that no cycle precedes. The cells that remain still wait for others.
std::vector<Waiting> peel(const Graph& graph, std::vector<CellId>& order) {
  std::vector<std::uint32_t> gaps = graph.gaps_into();
  std::vector<Waiting> waiting = all_waiting(graph, gaps);
  std::vector<CellId> ready;
  for (std::size_t i = waiting.size(); i-- > 0;)
    if (waiting[i].for_cells == 0) ready.push_back(static_cast<CellId>(i));
  // Last in, first out: consecutive cells of the order are neighbours. That helps the renderer more
  // than first in, first out would speed up this loop.
  CancellationCheck check;
  while (!ready.empty()) {
    check();
    const CellId cell = ready.back();
    ready.pop_back();
    order.push_back(cell);
    for (unsigned faces = waiting[cell].faces_behind; faces != 0; faces &= faces - 1) {
      const CellId behind = graph.neighbor(cell, static_cast<unsigned>(std::countr_zero(faces)));
      const unsigned left = --waiting[behind].for_cells;
      // a cell that becomes ready is visited next: its neighbours are fetched one step earlier
      if (left < 2) graph.fetch_neighbors(behind);
      if (left == 0) ready.push_back(behind);
    }
    for (const CellId behind : graph.gaps_behind(cell))
      if (--gaps[behind] == 0 && --waiting[behind].for_cells == 0) ready.push_back(behind);
  }
  return waiting;
}

// Tarjan's algorithm on the cells that still wait, without recursion. Components come out last
// first, each as a run of `reversed`; `ends` holds the end of each run.
class Tarjan {
 public:
  Tarjan(const Graph& graph, const std::vector<Waiting>& waiting)
      : graph_(graph), waiting_(waiting), index_(waiting.size(), kUnseen), low_(waiting.size(), 0) {
    for (std::size_t cell = 0; cell < waiting.size(); ++cell)
      if (waiting[cell].for_cells > 0 && index_[cell] == kUnseen) visit(static_cast<CellId>(cell));
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
      check_();
      auto& [cell, slot] = path_.back();
      if (slot == graph_.arrow_slots(cell)) {
        close(cell);
        continue;
      }
      const CellId behind = graph_.behind(cell, slot++);
      if (behind == kNoCell || waiting_[behind].for_cells == 0 || index_[behind] == kClosed)
        continue;
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
  const std::vector<Waiting>& waiting_;
  std::vector<std::uint32_t> index_, low_;
  std::vector<CellId> stack_;
  std::vector<std::pair<CellId, std::uint32_t>> path_;  // cell, its next arrow
  std::uint32_t next_index_ = 0;
  CancellationCheck check_;
};

}  // namespace

VisibilityOrder order_of_components(const BehindRelation& relation, const FaceNumbering& numbering,
                                    std::span<const CellId> neighbors, const GapRelation& gaps) {
  const Graph graph(relation, numbering, neighbors, gaps);
  std::vector<CellId> order;
  order.reserve(graph.cell_count());
  advise_large_pages(order.data(), order.capacity() * sizeof(CellId));
  const std::vector<Waiting> waiting = peel(graph, order);
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
