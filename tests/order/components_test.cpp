#include "hiac/order/components.hpp"

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/order/brute_force_order.hpp"

namespace hiac::test {
namespace {

using testing::ElementsAre;

// Cells of the most faces that a cell can have.
ZooMesh bricks(std::size_t cells) {
  ZooMesh mesh;
  mesh.kinds = std::vector<CellKind>(cells, CellKind::brick8);
  return mesh;
}

// The order of a relation made by hand: the arrows of `faces` run across shared faces as long as
// both cells have one left, the others and those of `gaps` across gaps.
VisibilityOrder order_of(std::size_t cells, const Arrows& faces, std::vector<GapArrow> gaps = {}) {
  const FaceNumbering numbering(bricks(cells));
  BehindRelation relation;
  relation.of_cell.resize(cells);
  std::vector<CellId> neighbors(numbering.first(cells), kNoCell);
  std::vector<std::size_t> used(cells, 0);
  for (const auto& [front, behind] : faces) {
    if (used[front] == 6 || used[behind] == 6) {
      gaps.push_back({front, behind});
      continue;
    }
    neighbors[6 * front + used[front]] = behind;
    neighbors[6 * behind + used[behind]] = front;
    relation.of_cell[front].set(used[front]++, kCellFirst);
    relation.of_cell[behind].set(used[behind]++, kNeighborFirst);
  }
  return order_of_components(relation, numbering, neighbors, sorted_by_cell(cells, gaps));
}

std::vector<CellId> cells_of(const VisibilityOrder& order) {
  return {order.cells.begin(), order.cells.end()};
}
std::vector<CellGroup> groups_of(const VisibilityOrder& order) {
  return {order.groups.begin(), order.groups.end()};
}

TEST(Components, NoCellsAndNoArrows) {
  EXPECT_TRUE(order_of(0, {}).cells.empty());
  EXPECT_TRUE(is_order_of({}, 3, order_of(3, {})));
}

TEST(Components, AChainComesOutInItsOrder) {
  EXPECT_THAT(cells_of(order_of(4, {{2, 0}, {0, 3}, {3, 1}})), ElementsAre(2, 0, 3, 1));
}

//   3 -> 0 -> 1 -> 2 -> 4
//        ^_________|
TEST(Components, ThreeCellsInACycle) {
  const VisibilityOrder order = order_of(5, {{3, 0}, {0, 1}, {1, 2}, {2, 0}, {2, 4}});
  EXPECT_THAT(cells_of(order), ElementsAre(3, 0, 1, 2, 4));
  EXPECT_THAT(groups_of(order), ElementsAre(CellGroup{1, 3}));
}

TEST(Components, ArrowsBothWaysAreACycleOfTwo) {
  const VisibilityOrder order = order_of(3, {{0, 1}, {1, 0}, {1, 2}});
  EXPECT_THAT(cells_of(order), ElementsAre(0, 1, 2));
  EXPECT_THAT(groups_of(order), ElementsAre(CellGroup{0, 2}));
}

TEST(Components, ACycleMayRunAcrossGaps) {
  const VisibilityOrder order = order_of(4, {{0, 1}, {1, 2}}, {{2, 0}, {3, 0}});
  EXPECT_THAT(cells_of(order), ElementsAre(3, 0, 1, 2));
  EXPECT_THAT(groups_of(order), ElementsAre(CellGroup{1, 3}));
}

TEST(Components, RandomGraphs) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 600; ++i) {
    const std::size_t cells = 1 + random() % 60;
    const std::size_t count = random() % (3 * cells);
    std::set<std::pair<CellId, CellId>> faces, gaps;
    for (std::size_t k = 0; k < count; ++k) {
      const auto a = static_cast<CellId>(random() % cells),
                 b = static_cast<CellId>(random() % cells);
      // mostly forwards, so that there are cycles of all sizes between single cells
      const bool backwards = random() % 8 == 0;
      if (a == b || (a > b) != backwards) continue;
      (random() % 4 == 0 ? gaps : faces).insert({a, b});
    }
    std::vector<GapArrow> gap_arrows;
    for (const auto& [front, behind] : gaps) gap_arrows.push_back({front, behind});
    const Arrows face_arrows(faces.begin(), faces.end());
    Arrows all = face_arrows;
    all.insert(all.end(), gaps.begin(), gaps.end());
    ASSERT_TRUE(is_order_of(all, cells, order_of(cells, face_arrows, gap_arrows))) << "graph " << i;
  }
}

// Deep graphs: nothing may recurse cell by cell.
TEST(Components, LongChainsAndRings) {
  constexpr CellId kCells = 1000000;
  Arrows chain;
  for (CellId cell = 0; cell + 1 < kCells; ++cell) chain.emplace_back(cell, cell + 1);
  EXPECT_TRUE(std::ranges::is_sorted(cells_of(order_of(kCells, chain))));
  chain.emplace_back(kCells - 1, 0);
  EXPECT_THAT(groups_of(order_of(kCells, chain)), ElementsAre(CellGroup{0, kCells}));
}

}  // namespace
}  // namespace hiac::test
