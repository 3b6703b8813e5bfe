#include "hiac/frame/cell_groups.hpp"

#include <cstdint>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hiac {
namespace {

using testing::ElementsAre;

VisibilityOrder order_with_groups() {
  VisibilityOrder order;
  order.cells = std::vector<CellId>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  order.groups = std::vector<CellGroup>{{2, 3}, {7, 2}, {9, 2}};  // 2 to 4, 7 and 8, 9 and 10
  return order;
}

// The runs that positions are drawn in, a group's with its number of cells negated.
std::vector<int> runs_of(const std::vector<std::uint32_t>& ranks, std::size_t most) {
  const VisibilityOrder order = order_with_groups();
  std::vector<int> lengths;
  for (std::span<const std::uint32_t> left(ranks); !left.empty();) {
    const CellRun run = first_run(order, left, most);
    EXPECT_EQ(run.ranks.data(), left.data());
    lengths.push_back(static_cast<int>(run.ranks.size()) * (run.is_group ? -1 : 1));
    left = left.subspan(run.ranks.size());
  }
  return lengths;
}

TEST(CellGroups, SeparateRuns) {
  EXPECT_THAT(runs_of({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, 100),
              ElementsAre(2, -3, 2, -2, -2, 1));
}

TEST(CellGroups, AreWhatTheTileHasOfThem) {
  EXPECT_THAT(runs_of({1, 3, 5, 8, 10}, 100), ElementsAre(1, -1, 1, -1, -1));
  EXPECT_THAT(runs_of({4, 6, 11}, 100), ElementsAre(-1, 1, 1));
  EXPECT_THAT(runs_of({5, 11}, 100), ElementsAre(1, 1));
}

TEST(CellGroups, OnlyRunsOfCellsInNoGroupAreLimited) {
  EXPECT_THAT(runs_of({0, 1, 2, 3, 4, 5, 6}, 1), ElementsAre(1, 1, -3, 1, 1));
}

TEST(CellGroups, NeedNotBe) {
  VisibilityOrder order;
  order.cells = std::vector<CellId>{0, 1, 2, 3, 4};
  const std::vector<std::uint32_t> ranks{0, 2, 3, 4};
  EXPECT_EQ(first_run(order, ranks, 3).ranks.size(), 3U);
  EXPECT_EQ(first_run(order, ranks, 9).ranks.size(), 4U);
  EXPECT_FALSE(first_run(order, ranks, 9).is_group);
}

}  // namespace
}  // namespace hiac
