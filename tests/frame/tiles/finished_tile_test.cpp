#include "hiac/frame/tiles/finished_tile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "hiac/frame/tiles/pixel_mask.hpp"

namespace hiac {
namespace {

TEST(TileSummary, TellsTheDepthOfTheMediumAlone) {
  TileSummary summary;
  summary.add_pixel(0.25, 1);
  EXPECT_EQ(summary.covered, 1U);
  EXPECT_EQ(summary.with_depth, 1U);
  EXPECT_DOUBLE_EQ(summary.optical_depth_sum, std::log(4.0));
  summary.add_pixel(0.125, 0.5);  // a quarter is left of a half
  EXPECT_EQ(summary.covered, 2U);
  EXPECT_EQ(summary.with_depth, 2U);
  EXPECT_DOUBLE_EQ(summary.optical_depth_sum, std::log(16.0));
  EXPECT_DOUBLE_EQ(summary.optical_depth_most, std::log(4.0));
}

TEST(TileSummary, SurfacesThatHideTheMediumTellNoDepth) {
  TileSummary summary;
  summary.add_pixel(0.0005, 0.001);
  EXPECT_EQ(summary.with_depth, 1U);
  summary.add_pixel(0.0005, 0.000999);
  EXPECT_EQ(summary.with_depth, 1U);
  EXPECT_EQ(summary.covered, 2U);
}

// A surface and no medium is not a medium of depth 0; a medium that absorbs nothing is.
TEST(TileSummary, SurfacesWithoutAMediumTellNoDepth) {
  TileSummary summary;
  summary.add_pixel(0.3, 0.3);
  summary.add_pixel(0.3 * (1 - 0.9e-14), 0.3);
  EXPECT_EQ(summary.with_depth, 0U);
  summary.add_pixel(0.3 * (1 - 1.2e-14), 0.3);
  EXPECT_EQ(summary.with_depth, 1U);
  summary.add_pixel(1, 1);
  EXPECT_EQ(summary.with_depth, 2U);
  EXPECT_EQ(summary.covered, 4U);
}

TEST(TileSummary, OpaqueMediaHaveTheDepthOfTheLeastNumber) {
  TileSummary summary;
  summary.add_pixel(0, 1);
  EXPECT_DOUBLE_EQ(summary.optical_depth_most, 1022 * std::log(2.0));
}

TEST(TileSummary, StatisticsAreMeansOverPixelsThatTellADepth) {
  TileSummary one{{5, 1}}, two{{7, 2}};
  one.add_pixel(std::exp(-1.0), 1);
  one.add_pixel(std::exp(-2.0), 1);
  two.add_pixel(std::exp(-6.0), 1);
  two.add_pixel(0, 0);
  const RenderStatistics all = statistics_of(std::vector{one, two, TileSummary{}});
  EXPECT_EQ(all.segments, 12U);
  EXPECT_EQ(all.violations, 3U);
  EXPECT_EQ(all.covered_pixels, 4U);
  EXPECT_EQ(all.depth_pixels, 3U);
  EXPECT_NEAR(all.mean_optical_depth, 3, 1e-14);
  EXPECT_NEAR(all.largest_optical_depth, 6, 1e-14);
  EXPECT_EQ(statistics_of({}).mean_optical_depth, 0);
}

TEST(Statistics, OfPicturesAreJoined) {
  RenderStatistics sum, other;
  sum += other;  // neither has a pixel
  EXPECT_EQ(sum.mean_optical_depth, 0);
  other.segments = 3, other.violations = 2, other.covered_pixels = 9, other.depth_pixels = 4;
  other.mean_optical_depth = 2, other.largest_optical_depth = 5, other.splatted_cells = 6;
  other.prepare_seconds = 1, other.tile_seconds = 10;
  sum += other;
  EXPECT_EQ(sum.mean_optical_depth, 2);
  other.depth_pixels = 12, other.mean_optical_depth = 6, other.largest_optical_depth = 3;
  other.splatted_cells = 1;
  sum += other;
  EXPECT_EQ(sum.mean_optical_depth, 5);
  EXPECT_EQ(sum.largest_optical_depth, 5);
  EXPECT_EQ(sum.depth_pixels, 16U);
  EXPECT_EQ(sum.covered_pixels, 18U);
  EXPECT_EQ(sum.segments, 6U);
  EXPECT_EQ(sum.violations, 4U);
  EXPECT_EQ(sum.splatted_cells, 6U);
  EXPECT_EQ(sum.prepare_seconds, 2);
  EXPECT_EQ(sum.tile_seconds, 20);
  sum += RenderStatistics{};  // of no pixel
  EXPECT_EQ(sum.mean_optical_depth, 5);
}

TEST(Tile, FirstCentersAreAtACoordinateOrBehindIt) {
  EXPECT_EQ(first_center(3.5, 0, 10), 3);
  EXPECT_EQ(first_center(3.5000001, 0, 10), 4);
  EXPECT_EQ(first_center(3.4999999, 0, 10), 3);
  EXPECT_EQ(first_center(2.5000001, 0, 10), 3);
  EXPECT_EQ(first_center(3.625, 0, 10, 0.125), 3);
  EXPECT_EQ(first_center(3.626, 0, 10, 0.125), 4);
  EXPECT_EQ(first_center(-1e300, 2, 10), 2);
  EXPECT_EQ(first_center(1e300, 2, 10), 10);
  EXPECT_EQ(first_center(2.6, 3, 10), 3);
}

TEST(Tile, IndicesOfPixelsAreInverted) {
  const TileRect tile{128, 96, 192, 128};
  std::set<std::size_t> met;
  for (int y = 96; y < 128; ++y)
    for (int x = 128; x < 192; ++x) {
      const std::size_t at = tile.index(x, y);
      EXPECT_LT(at, kTilePlane);
      EXPECT_EQ(tile.column(at), x);
      EXPECT_EQ(tile.row(at), y);
      met.insert(at);
    }
  EXPECT_EQ(met.size(), kTileWidth * kTileHeight);
}

TEST(PixelMask, HoldsWhatWasAdded) {
  std::mt19937 random(1);
  const TileRect tile{0, 0, 64, 32};
  PixelMask mask, other;
  EXPECT_FALSE(mask.any());
  std::set<std::pair<int, int>> expected;
  for (int i = 0; i < 400; ++i) {
    const int x = static_cast<int>(random() % 64), y = static_cast<int>(random() % 32);
    if (i % 4 == 3) {
      mask.remove(tile.index(x, y));
      expected.erase({x, y});
    } else {
      mask.add(tile.index(x, y));
      expected.insert({x, y});
    }
    const int column = static_cast<int>(random() % 64), row = static_cast<int>(random() % 32);
    other.add(tile.index(column, row));
  }
  const auto check = [&](const PixelMask& of) {
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 64; ++x) {
        const bool in = expected.contains({x, y});
        ASSERT_EQ(of.holds(x, y), in) << x << ' ' << y;
        ASSERT_EQ(of.holds(tile.index(x, y)), in);
        ASSERT_EQ((of.row(y) >> x & 1U) != 0, in);
      }
  };
  check(mask);
  EXPECT_TRUE(mask.any());
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x)
      if (other.holds(x, y)) expected.insert({x, y});
  mask.add_rows(other.rows());
  check(mask);
}

}  // namespace
}  // namespace hiac
