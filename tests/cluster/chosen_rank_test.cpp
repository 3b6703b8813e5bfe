#include "hiac/cluster/chosen_rank.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace hiac {
namespace {

// The faces of a grid have neighbouring numbers; shares of independent draws differ from their mean
// by its root, here by six of them at most.
TEST(ChosenRank, SpreadsNeighbouringKeysEvenly) {
  constexpr std::uint32_t kKeys = 64000;
  for (const std::uint32_t ranks : {1U, 2U, 3U, 8U, 64U}) {
    std::vector<std::uint32_t> keys(ranks);
    for (std::uint64_t n = 0; n < kKeys; ++n)
      ++keys[chosen_rank(std::array<std::uint64_t, 3>{n, n + 1, n + 41}, ranks)];
    const double mean = double(kKeys) / ranks;
    for (const std::uint32_t count : keys) EXPECT_NEAR(count, mean, 6 * std::sqrt(mean)) << ranks;
  }
}

TEST(ChosenRank, DependsOnEachNumberOfTheKey) {
  constexpr std::uint32_t kRanks = 1000;
  using Key = std::array<std::uint64_t, 4>;
  const Key key{7, 8, 9, 10};
  for (std::size_t changed = 0; changed < key.size(); ++changed) {
    std::uint32_t same = 0;
    for (std::uint64_t n = 1; n <= 100; ++n) {
      Key other = key;
      other[changed] += n;
      if (chosen_rank(other, kRanks) == chosen_rank(key, kRanks)) ++same;
    }
    EXPECT_LE(same, 5U) << changed;
  }
}

}  // namespace
}  // namespace hiac
