// Based on: P. Williams, N. Max, C. Stein, "A High Accuracy Volume Renderer for Unstructured Data",
// 1998, section 6.2, steps 5 to 8, and section 6 if there is one tile.
//
// Differences: after a cell Q that P obstructs was moved before P and output, P continues after Q
// instead of starting again; the tile where extents begin (SortingTiles) ensures that a pair is
// tested once, instead of a note in Q; tests against cells later in the list are made beforehand,
// in parallel, because almost all of them are needed anyway. None of this changes the order.

#include "hiac/order/published/pair_sort.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "hiac/base/collect.hpp"
#include "hiac/base/parallel_sort.hpp"
#include "hiac/order/published/cell_obstruction.hpp"
#include "hiac/order/published/rough_order.hpp"
#include "hiac/order/published/screen_extents.hpp"
#include "hiac/order/published/sorting_tiles.hpp"
#include "hiac/order/published/visibility_cycle.hpp"

namespace hiac {
namespace {

// Ranks of two cells: the first obstructs the second, which comes later in the rough order.
using Exception = std::pair<std::uint32_t, std::uint32_t>;

// Calls visit(other) for every place in [begin, end) whose extent meets that of `place`, if this
// tile is the one that pairs the two. These are the first two tests of Obstructs, with the same
// tests along the diagonals.
template <typename Visit>
void for_each_meeting(const SortingTiles& tiles, std::size_t place, std::size_t begin,
                      std::size_t end, const Visit& visit) {
  constexpr std::size_t kBlock = 32;
  const float x_low = tiles.x_low[place], x_high = tiles.x_high[place];
  const float y_low = tiles.y_low[place], y_high = tiles.y_high[place];
  for (std::size_t block = begin; block < end; block += kBlock) {
    const std::size_t count = std::min(kBlock, end - block);
    const float *xl = &tiles.x_low[block], *xh = &tiles.x_high[block];
    const float *yl = &tiles.y_low[block], *yh = &tiles.y_high[block];
    std::array<std::uint8_t, kBlock> meets{};
    for (std::size_t k = 0; k < count; ++k)
      meets[k] = static_cast<std::uint8_t>((xl[k] <= x_high) & (xh[k] >= x_low) &
                                           (yl[k] <= y_high) & (yh[k] >= y_low));
    for (std::size_t eighth = 0; eighth < kBlock; eighth += 8) {
      std::uint64_t left = 0;
      std::memcpy(&left, meets.data() + eighth, 8);
      for (; left != 0; left &= left - 1) {
        const std::size_t other =
            block + eighth + static_cast<std::size_t>(std::countr_zero(left)) / 8;
        if (tiles.pairs_here(place, other) && tiles.diagonals_meet(place, other)) visit(other);
      }
    }
  }
}

// A run of a tile's places.
struct Work {
  std::size_t begin, end, tile_end;
};

class PairSort {
 public:
  PairSort(const ZooMesh& mesh, const View& view, double planarity, const TilingOptions& tiling)
      : rough_(rough_order(mesh, view)),
        tiles_(sorting_tiles(screen_extents(mesh, view, rough_.cells), mesh.cell_count(), tiling)),
        obstruction_(mesh, view, planarity) {
    find_exceptions();
  }

  // Returns the cells back to front.
  std::vector<CellId> run() {
    const auto count = static_cast<std::uint32_t>(rough_.cells.size());
    states_.assign(count, State::waiting);
    heads_.assign(tiles_.start.begin(), tiles_.start.end() - 1);
    order_.reserve(count);
    for (std::uint32_t rank = 0; rank < count; ++rank)
      if (states_[rank] == State::waiting) put_out(rank);
    return std::move(order_);
  }

 private:
  enum class State : std::uint8_t { waiting, on_path, out };

  // A cell P at the head of the list. It may obstruct the cells candidates_[next], ..., of which
  // those before `first_exception` precede it in the rough order and are still untested.
  struct Step {
    std::uint32_t rank;
    std::size_t begin, next, first_exception;
  };

  void find_exceptions() {
    constexpr std::size_t kRun = 256;
    std::vector<Work> works;
    for (std::size_t tile = 0; tile < tiles_.tile_count(); ++tile)
      for (std::size_t begin = tiles_.start[tile]; begin < tiles_.start[tile + 1]; begin += kRun)
        works.push_back(
            {begin, std::min(begin + kRun, tiles_.start[tile + 1]), tiles_.start[tile + 1]});
    exceptions_ =
        collect<Exception>(works.size(), 1, [&](std::size_t w, std::vector<Exception>& found) {
          for (std::size_t place = works[w].begin; place < works[w].end; ++place)
            test_later_cells(place, works[w].tile_end, found);
        });
    parallel_sort(exceptions_, std::less<>());
    exceptions_.erase(std::unique(exceptions_.begin(), exceptions_.end()), exceptions_.end());
    first_exception_.assign(rough_.cells.size() + 1, 0);
    for (const Exception& e : exceptions_) ++first_exception_[e.first + 1];
    for (std::size_t rank = 0; rank < rough_.cells.size(); ++rank)
      first_exception_[rank + 1] += first_exception_[rank];
  }

  // Tests a cell P against the cells Q later in the tile's list whose rearmost depth lies behind
  // P's frontmost.
  void test_later_cells(std::size_t place, std::size_t tile_end,
                        std::vector<Exception>& found) const {
    const std::uint32_t p = tiles_.ranks[place];
    const double frontmost = rough_.frontmost[p];
    const auto ranks = tiles_.ranks.begin();
    const auto end =
        std::partition_point(ranks + static_cast<std::ptrdiff_t>(place) + 1,
                             ranks + static_cast<std::ptrdiff_t>(tile_end),
                             [&](std::uint32_t q) { return rough_.rearmost[q] >= frontmost; });
    CellObstruction::Cell cell = obstruction_.cell(rough_.cells[p]);
    for_each_meeting(tiles_, place, place + 1, static_cast<std::size_t>(end - ranks),
                     [&](std::size_t other) {
                       const std::uint32_t q = tiles_.ranks[other];
                       CellObstruction::Cell other_cell = obstruction_.cell(rough_.cells[q]);
                       if (obstruction_.obstructs(cell, other_cell)) found.emplace_back(p, q);
                     });
  }

  // Outputs a cell after the cells that it obstructs.
  void put_out(std::uint32_t root) {
    move_to_head(root);
    while (!path_.empty()) {
      Step& step = path_.back();
      if (step.next == candidates_.size()) {
        finish();
        continue;
      }
      const std::uint32_t p = step.rank, q = candidates_[step.next];
      const bool known = step.next >= step.first_exception;
      ++step.next;
      if (states_[q] == State::out || !(known || obstructs(p, q))) continue;
      if (states_[q] == State::on_path) report_cycle(q);
      move_to_head(q);
    }
  }

  void move_to_head(std::uint32_t rank) {
    states_[rank] = State::on_path;
    const std::size_t begin = candidates_.size();
    if (!path_.empty()) add_earlier_cells(rank);
    const std::size_t first_exception = candidates_.size();
    for (std::size_t e = first_exception_[rank]; e < first_exception_[rank + 1]; ++e)
      candidates_.push_back(exceptions_[e].second);
    path_.push_back({rank, begin, begin, first_exception});
  }

  // Adds the cells that are still in the list before a cell that was moved. They stay in their
  // places and must all be tested: their rearmost depths lie behind the moved cell's, which may
  // therefore obstruct them.
  void add_earlier_cells(std::uint32_t rank) {
    const auto begin = static_cast<std::ptrdiff_t>(candidates_.size());
    for (const std::size_t place : tiles_.places(rank)) {
      const std::size_t tile = tile_of(place);
      std::size_t& head = heads_[tile];
      while (head < place && states_[tiles_.ranks[head]] == State::out) ++head;
      for_each_meeting(tiles_, place, head, place, [&](std::size_t other) {
        const std::uint32_t q = tiles_.ranks[other];
        if (states_[q] != State::out) candidates_.push_back(q);
      });
    }
    std::sort(candidates_.begin() + begin, candidates_.end());
    candidates_.erase(std::unique(candidates_.begin() + begin, candidates_.end()),
                      candidates_.end());
  }

  [[nodiscard]] std::size_t tile_of(std::size_t place) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(tiles_.start, place) -
                                    tiles_.start.begin()) -
           1;
  }

  [[nodiscard]] bool obstructs(std::uint32_t p, std::uint32_t q) const {
    CellObstruction::Cell p_cell = obstruction_.cell(rough_.cells[p]);
    CellObstruction::Cell q_cell = obstruction_.cell(rough_.cells[q]);
    return obstruction_.obstructs(p_cell, q_cell);
  }

  void finish() {
    const Step& step = path_.back();
    states_[step.rank] = State::out;
    order_.push_back(rough_.cells[step.rank]);
    candidates_.resize(step.begin);
    path_.pop_back();
  }

  // Throws. Every cell on the path obstructs the next one, and the last one obstructs `rank`.
  [[noreturn]] void report_cycle(std::uint32_t rank) const {
    std::vector<CellId> cells;
    auto step = std::ranges::find(path_, rank, &Step::rank);
    for (; step != path_.end(); ++step) cells.push_back(rough_.cells[step->rank]);
    throw VisibilityCycle(std::move(cells));
  }

  RoughOrder rough_;
  SortingTiles tiles_;
  CellObstruction obstruction_;
  std::vector<Exception> exceptions_;         // sorted
  std::vector<std::size_t> first_exception_;  // by rank
  std::vector<State> states_;                 // by rank
  std::vector<std::size_t> heads_;  // by tile: the first place whose cell may still be in the list
  std::vector<Step> path_;
  std::vector<std::uint32_t> candidates_;  // ranks, of all cells on the path
  std::vector<CellId> order_;
};

}  // namespace

std::vector<CellId> sort_pairs(const ZooMesh& mesh, const View& view, double planarity,
                               const TilingOptions& tiling) {
  if (mesh.cell_count() == 0) return {};
  std::vector<CellId> cells = PairSort(mesh, view, planarity, tiling).run();
  std::ranges::reverse(cells);
  return cells;
}

}  // namespace hiac
