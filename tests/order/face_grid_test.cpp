#include "hiac/order/gaps/face_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace hiac {
namespace {

using Random = std::mt19937_64;

Outline rectangle(double x_low, double x_high, double y_low, double y_high) {
  return {{x_low, x_high}, {y_low, y_high}, {0, 1}, {}, {}, 0};
}

// Rectangles of all sizes around a point, some without width.
std::vector<Outline> random_outlines(std::size_t count, Random& random) {
  std::uniform_real_distribution<double> number(0, 1);
  std::vector<Outline> outlines;
  for (std::size_t k = 0; k < count; ++k) {
    const double x = 100 + 3 * number(random), y = -7 + 0.5 * number(random);
    const double size = 0.2 * std::pow(number(random), 3);
    outlines.push_back(rectangle(x, k % 10 == 0 ? x : x + size, y, y + size * number(random)));
  }
  return outlines;
}

FaceExtent extent_of(const std::vector<Outline>& outlines) {
  FaceExtent extent;
  for (const Outline& outline : outlines) extent.include(outline);
  return extent;
}

TEST(FaceGrid, ExtentsAddUpSizes) {
  const FaceExtent extent =
      extent_of({rectangle(1, 3, 4, 4.5), rectangle(-2, 0, 9, 12), rectangle(0, 0.25, -1, 0)});
  EXPECT_EQ(extent.x.low, -2);
  EXPECT_EQ(extent.x.high, 3);
  EXPECT_EQ(extent.y.low, -1);
  EXPECT_EQ(extent.y.high, 12);
  EXPECT_EQ(extent.sum_of_widths, 4.25);
  EXPECT_EQ(extent.sum_of_heights, 4.5);
  EXPECT_EQ(extent.faces, 3U);
}

FaceGrid grid_of(double width, double sum_of_widths, double height, double sum_of_heights,
                 std::size_t faces) {
  return FaceGrid({{5, 5 + width}, {-1, -1 + height}, sum_of_widths, sum_of_heights, faces});
}

// As many tiles as mean faces fit beside one another, and not more than the root of their number.
TEST(FaceGrid, TilesAreAboutAsLargeAsTheMeanFace) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(grid_of(10, 100 * 2, 1, 100 * 0.3, 100).tiles(), 5U * 3U);
  EXPECT_EQ(grid_of(10, 100 * 0.01, 1, 100 * 0.3, 100).tiles(), 10U * 3U);
  EXPECT_EQ(grid_of(10, 100 * 2, 1, 100 * 0.01, 100).tiles(), 5U * 10U);
  EXPECT_EQ(grid_of(10, 100 * 20, 1, 100 * 2, 100).tiles(), 1U);
  EXPECT_EQ(grid_of(10, 1, 10, 1, 9000000).tiles(), 2048U * 2048U);
  EXPECT_EQ(grid_of(10, 1, 0, 0, 100).tiles(), 10U);
  EXPECT_EQ(grid_of(10, 0, 10, 1, 100).tiles(), 10U);
  EXPECT_EQ(grid_of(kNaN, 1, kNaN, 1, 100).tiles(), 1U);
  EXPECT_EQ(grid_of(HUGE_VAL, 1, 10, 1, 100).tiles(), 10U);
}

// Steps are 1 / 32767 of the width, rounded outwards.
TEST(FaceGrid, BoundsAreRoundedOutwards) {
  const FaceGrid grid = grid_of(32767, 1, 327.67, 1, 100);
  const auto bounds = [&](const Outline& outline) {
    return grid.binned(outline, 0, true, 0).bounds;
  };
  const GridBounds inside = bounds(rectangle(5 + 10.25, 5 + 20.25, -1 + 0.305, -1 + 1.105));
  EXPECT_EQ(inside.x_low, 10);
  EXPECT_EQ(inside.x_high, 21);
  EXPECT_EQ(inside.y_low, 30);
  EXPECT_EQ(inside.y_high, 111);
  const GridBounds beyond = bounds(rectangle(4, 5 + 40000, -2, 400));
  EXPECT_EQ(beyond.x_low, 0);
  EXPECT_EQ(beyond.x_high, 32767);
  EXPECT_EQ(beyond.y_low, 0);
  EXPECT_EQ(beyond.y_high, 32767);
  const GridBounds before = bounds(rectangle(3, 4, -3, -2));
  EXPECT_EQ(before.x_high, 0);
  EXPECT_EQ(before.y_high, 0);
  const GridBounds behind = bounds(rectangle(50000, 50001, 500, 600));
  EXPECT_EQ(behind.x_low, 32767);
  EXPECT_EQ(behind.y_low, 32767);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const GridBounds unknown = bounds(rectangle(kNaN, kNaN, kNaN, kNaN));
  EXPECT_EQ(unknown.x_low, 0);
  EXPECT_EQ(unknown.x_high, 32767);
  // in a grid without height
  const GridBounds flat =
      grid_of(32767, 1, 0, 1, 100).binned(rectangle(6, 7, -1, -1), 0, true, 0).bounds;
  EXPECT_EQ(flat.y_low, 0);
  EXPECT_EQ(flat.y_high, 0);
}

TEST(FaceGrid, DepthsAreRoundedTheWayThatIsAskedFor) {
  const FaceGrid grid = grid_of(1, 1, 1, 1, 1);
  const auto depth = [&](double value, bool upwards) {
    return grid.binned(rectangle(5, 6, 0, 0), value, upwards, 3).depth;
  };
  EXPECT_EQ(grid.binned(rectangle(5, 6, 0, 0), 1, true, 3).face, 3U);
  for (const bool upwards : {false, true}) EXPECT_EQ(depth(0.25, upwards), 0.25F);
  const float up = std::nextafter(0.25F, 1.F), down = std::nextafter(0.25F, 0.F);
  // nearer to 0.25 than to its neighbours, and the other way round
  EXPECT_EQ(depth(0.25 + 1e-12, true), up);
  EXPECT_EQ(depth(0.25 + 1e-12, false), 0.25F);
  EXPECT_EQ(depth(0.25 - 1e-12, true), 0.25F);
  EXPECT_EQ(depth(0.25 - 1e-12, false), down);
  EXPECT_EQ(depth(static_cast<double>(up) - 1e-12, true), up);
  EXPECT_EQ(depth(static_cast<double>(up) - 1e-12, false), 0.25F);
}

// Every tile holds the faces whose bounds reach it, in their order; and two that meet meet in the
// tile of the larger of their first steps.
TEST(FaceGrid, FacesAreInTheTilesThatTheyMeet) {
  Random random(1);
  const std::vector<Outline> outlines = random_outlines(300, random);
  const FaceGrid grid(extent_of(outlines));
  EXPECT_GT(grid.tiles(), 20U);
  EXPECT_LE(grid.tiles(), 17U * 17U);
  std::vector<BinnedFace> faces;
  for (std::uint32_t f = 0; f < outlines.size(); ++f)
    faces.push_back(grid.binned(outlines[f], static_cast<double>(f), true, f));
  const FaceBins bins = grid.bin(faces);
  ASSERT_EQ(bins.start.size(), grid.tiles() + 1);
  for (std::size_t t = 0; t < grid.tiles(); ++t) {
    std::vector<std::uint32_t> expected, found;
    for (const BinnedFace& face : bins[t]) found.push_back(face.face);
    for (const BinnedFace& face : faces) {
      bool in = false;
      const GridBounds& b = face.bounds;
      // all steps of the bounds' border and a few between them
      for (const unsigned x : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U})
        for (const unsigned y : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U})
          in = in || grid.tile_at(
                         static_cast<std::uint16_t>(b.x_low + (b.x_high - b.x_low) * x / 8),
                         static_cast<std::uint16_t>(b.y_low + (b.y_high - b.y_low) * y / 8)) == t;
      if (in) expected.push_back(face.face);
    }
    EXPECT_EQ(found, expected) << t;
  }
  for (const BinnedFace& a : faces)
    for (const BinnedFace& b : faces) {
      const Outline &p = outlines[a.face], &q = outlines[b.face];
      const bool meet =
          p.x.low <= q.x.high && q.x.low <= p.x.high && p.y.low <= q.y.high && q.y.low <= p.y.high;
      if (!meet) continue;
      EXPECT_TRUE(MeetingTest(a.bounds).meets(MeetingTest::prepared(b.bounds)));
      const std::size_t t = grid.tile_at(std::max(a.bounds.x_low, b.bounds.x_low),
                                         std::max(a.bounds.y_low, b.bounds.y_low));
      for (const std::uint32_t face : {a.face, b.face})
        EXPECT_EQ(std::ranges::count(bins[t], face, &BinnedFace::face), 1);
    }
}

TEST(MeetingTest, IsThatOfRectangles) {
  Random random(2);
  std::size_t met = 0, apart = 0;
  for (const unsigned most : {3U, 40U, 0x7fffU})
    for (int trial = 0; trial < 3000; ++trial) {
      const auto number = [&] { return static_cast<std::uint16_t>(random() % (most + 1)); };
      const auto bounds = [&] {
        const auto x = std::minmax({number(), number()}), y = std::minmax({number(), number()});
        return GridBounds{x.first, y.first, x.second, y.second};
      };
      const GridBounds a = bounds(), b = bounds();
      const bool expected =
          a.x_low <= b.x_high && b.x_low <= a.x_high && a.y_low <= b.y_high && b.y_low <= a.y_high;
      EXPECT_EQ(MeetingTest(a).meets(MeetingTest::prepared(b)), expected);
      ++(expected ? met : apart);
    }
  EXPECT_GT(met, 1000U);
  EXPECT_GT(apart, 1000U);
  const GridBounds all{0, 0, 0x7fff, 0x7fff}, first{0, 0, 0, 0},
      last{0x7fff, 0x7fff, 0x7fff, 0x7fff};
  for (const GridBounds& other : {all, first, last})
    EXPECT_TRUE(MeetingTest(all).meets(MeetingTest::prepared(other)));
  EXPECT_FALSE(MeetingTest(first).meets(MeetingTest::prepared(last)));
  EXPECT_FALSE(MeetingTest(last).meets(MeetingTest::prepared(first)));
}

}  // namespace
}  // namespace hiac
