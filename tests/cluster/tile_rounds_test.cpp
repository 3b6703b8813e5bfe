// The tiles of a picture in rounds: every one once, all over the picture, and no more bytes than
// fit.
#include "hiac/cluster/tile_rounds.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace hiac {
namespace {

using RoundTiles = std::vector<std::uint32_t>;

// All that are left, each round after so many bytes a tile.
std::vector<RoundTiles> rounds_of(TileRounds& rounds, std::uint64_t bytes_a_tile) {
  std::vector<RoundTiles> all;
  while (!rounds.at_end()) {
    all.push_back(rounds.next());
    rounds.note_bytes(bytes_a_tile * all.back().size());
  }
  return all;
}

std::vector<std::size_t> sizes_of(const std::vector<RoundTiles>& rounds) {
  std::vector<std::size_t> sizes;
  for (const RoundTiles& round : rounds) sizes.push_back(round.size());
  return sizes;
}

TEST(TileRounds, HaveEveryTileOnce) {
  for (const std::uint32_t tiles : {0U, 1U, 15U, 16U, 17U, 200U, 1000U}) {
    TileRounds rounds(tiles);
    RoundTiles seen;
    for (const RoundTiles& round : rounds_of(rounds, TileRounds::kMostBytes / 40))
      seen.insert(seen.end(), round.begin(), round.end());
    std::ranges::sort(seen);
    RoundTiles expected(tiles);
    std::iota(expected.begin(), expected.end(), 0U);
    EXPECT_EQ(seen, expected) << tiles;
  }
}

// The first has 16; then as many as would have fitted, at most four times as many.
TEST(TileRounds, GrowToWhatFits) {
  constexpr std::uint64_t kMost = TileRounds::kMostBytes;
  const auto sizes = [](std::uint32_t tiles, std::uint64_t bytes_a_tile) {
    TileRounds rounds(tiles);
    return sizes_of(rounds_of(rounds, bytes_a_tile));
  };
  using Sizes = std::vector<std::size_t>;
  EXPECT_EQ(sizes(400, 0), (Sizes{16, 64, 256, 64}));
  EXPECT_EQ(sizes(400, 1), (Sizes{16, 64, 256, 64}));
  EXPECT_EQ(sizes(100, kMost / 32), (Sizes{16, 32, 32, 20}));
  EXPECT_EQ(sizes(30, kMost / 4), (Sizes{16, 4, 4, 4, 2}));
  EXPECT_EQ(sizes(19, 3 * kMost), (Sizes{16, 1, 1, 1}));
}

TEST(TileRounds, KeepTheLimit) {
  TileRounds rounds(60);
  rounds.limit(10);
  EXPECT_EQ(sizes_of(rounds_of(rounds, 0)), (std::vector<std::size_t>{10, 10, 10, 10, 10, 10}));
  TileRounds later(60);
  EXPECT_EQ(later.next().size(), 16U);
  later.limit(20);
  later.note_bytes(1);
  EXPECT_EQ(sizes_of(rounds_of(later, 1)), (std::vector<std::size_t>{20, 20, 4}));
}

// Of 1000 tiles in their order, every tenth has its share of the first 16 and of the next 64.
TEST(TileRounds, LieAllOverThePicture) {
  TileRounds rounds(1000);
  for (const auto& [size, least, most] : {std::array{16U, 1U, 3U}, {64U, 5U, 8U}}) {
    const RoundTiles round = rounds.next();
    ASSERT_EQ(round.size(), size);
    rounds.note_bytes(1);
    std::array<std::uint32_t, 10> counts{};
    for (const std::uint32_t tile : round) ++counts[tile / 100];
    EXPECT_GE(*std::ranges::min_element(counts), least);
    EXPECT_LE(*std::ranges::max_element(counts), most);
  }
}

TEST(TotalSize, AddsUpTheMessages) {
  EXPECT_EQ(total_size({}), 0U);
  EXPECT_EQ(total_size({Bytes(3), Bytes(), Bytes(39)}), 42U);
}

}  // namespace
}  // namespace hiac
