#include "hiac/render/pixels/tile.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace hiac {
namespace {

struct Segment {
  double front, back;
};

// Pixels of a tile, all transparent.
std::unique_ptr<TileBuffer> empty_buffer() {
  auto buffer = std::make_unique<TileBuffer>();
  for (auto* plane : {&buffer->red, &buffer->green, &buffer->blue}) plane->fill(0);
  buffer->transparency.fill(1);
  buffer->last.fill(-1e9);
  return buffer;
}

// The segments' numbers as they are composited: number k shines with k + 1 and lets a tenth
// through, so that the light's decimal digits are the numbers in their order.
std::vector<int> composited(const std::vector<Segment>& segments) {
  constexpr std::uint32_t kPixel = kTileStride + 5;
  SegmentList list;
  for (std::size_t k = 0; k < segments.size(); ++k)
    list.segments.push_back(
        {kPixel, segments[k].front, segments[k].back, {{static_cast<double>(k + 1), 0, 0}, 0.1}});
  const auto buffer = empty_buffer();
  TileCounts counts;
  composite_sorted(list, 1e9, *buffer, counts);
  std::vector<int> numbers;
  double light = buffer->red[kPixel];
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const double digit = std::floor(light + 1e-6);
    numbers.push_back(static_cast<int>(digit));
    light = 10 * (light - digit);
  }
  return numbers;
}

TEST(CompositeSorted, TheNearerFrontComesFirst) {
  EXPECT_EQ(composited({{3, 9}, {1, 20}, {2, 2.5}}), (std::vector{2, 3, 1}));
}

TEST(CompositeSorted, OfEqualFrontsTheNearerBackComesFirst) {
  EXPECT_EQ(composited({{1, 4}, {1, 2}, {1, 3}, {0, 5}}), (std::vector{4, 2, 3, 1}));
  // one of no length lies in front of one that begins there, and behind one that ends there
  EXPECT_EQ(composited({{1, 2}, {1, 1}, {0, 1}}), (std::vector{3, 2, 1}));
}

TEST(CompositeSorted, EqualSegmentsStayInTheirOrder) {
  EXPECT_EQ(composited({{1, 2}, {1, 2}, {1, 2}, {1, 2}, {1, 2}}), (std::vector{1, 2, 3, 4, 5}));
  EXPECT_EQ(composited({{1, 2}, {0, 3}, {1, 2}, {0, 3}, {1, 2}}), (std::vector{2, 4, 1, 3, 5}));
}

TEST(CompositeSorted, NearerIsATotalOrder) {
  SegmentList list;
  std::mt19937 random(5);
  std::uniform_int_distribution<int> few(0, 2);
  for (int k = 0; k < 40; ++k) {
    const double front = few(random);
    list.segments.push_back({0, front, front + few(random), {}});
  }
  for (std::uint32_t a = 0; a < list.segments.size(); ++a)
    for (std::uint32_t b = 0; b < list.segments.size(); ++b) {
      ASSERT_EQ(list.nearer(a, b) + list.nearer(b, a), a == b ? 0 : 1);
      if (list.segments[a].front == list.segments[b].front &&
          list.segments[a].back == list.segments[b].back) {
        ASSERT_EQ(list.nearer(a, b), a < b);
      }
    }
}

// Behind a segment that ends at 10, one that begins at `front` and is `length` long, with a
// tolerance of a quarter.
std::uint64_t violations_of(double front, double length) {
  const auto buffer = empty_buffer();
  buffer->last[7] = 10;
  SegmentList list;
  list.segments.push_back({7, front, front + length, {}});
  TileCounts counts;
  composite_sorted(list, 0.25, *buffer, counts);
  EXPECT_EQ(buffer->last[7], std::max(10.0, front + length));
  return counts.violations;
}

// Both have to hold: it begins too early by more than the tolerance, and is longer than that.
TEST(CompositeSorted, CountsLongSegmentsThatBeginTooEarly) {
  EXPECT_EQ(violations_of(9, 1), 1U);
  EXPECT_EQ(violations_of(9, 3), 1U);
  EXPECT_EQ(violations_of(10, 1), 0U);
  EXPECT_EQ(violations_of(9.75, 1), 0U);  // just the tolerance
  EXPECT_EQ(violations_of(9.75 - 0x1p-20, 1), 1U);
  EXPECT_EQ(violations_of(11, 0.125), 0U);
}

TEST(CompositeSorted, DoesNotCountShortSegments) {
  EXPECT_EQ(violations_of(2, 0), 0U);
  EXPECT_EQ(violations_of(2, 0.125), 0U);
  EXPECT_EQ(violations_of(2, 0.25), 0U);  // just the tolerance
  EXPECT_EQ(violations_of(2, 0.25 + 0x1p-20), 1U);
}

// Details count what statistics count.
TEST(CompositeSorted, PixelsCountTheirOwn) {
  const auto buffer = empty_buffer();
  buffer->details.resize(buffer->red.size());
  SegmentList list;
  for (const std::uint32_t pixel : {3U, 9U}) {
    list.segments.push_back({pixel, 0, 4, {}});
    list.segments.push_back({pixel, 1, 2, {}});  // within the first
    if (pixel == 9) list.segments.push_back({pixel, 3, 5, {}});
    list.segments.push_back({pixel, 3.5, 3.5, {}});  // short
  }
  for (std::size_t k = 0; k < list.segments.size(); ++k)
    list.details.push_back({.front = list.segments[k].front, .back = list.segments[k].back});
  TileCounts counts;
  composite_sorted(list, 0.25, *buffer, counts);
  EXPECT_EQ(counts.violations, 3U);
  EXPECT_EQ(buffer->details[3].violations, 1U);
  EXPECT_EQ(buffer->details[9].violations, 2U);
  EXPECT_EQ(buffer->last[3], 4);
  EXPECT_EQ(buffer->last[9], 5);
}

// Against compositing pixel by pixel, whatever order the segments come in.
TEST(CompositeSorted, AddsUpEveryPixel) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto buffer = empty_buffer();
  for (double& t : buffer->transparency) t = unit(random);
  const auto expected = std::make_unique<TileBuffer>(*buffer);
  SegmentList list;
  std::vector<std::uint32_t> sorted(3000);
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    const auto pixel = static_cast<std::uint32_t>(unit(random) * kTileStride * kTileHeight);
    const double front = unit(random);
    list.segments.push_back({k % 7 == 0 ? kTileStride * kTileHeight - 1 : pixel,
                             front,
                             front + unit(random),
                             {{unit(random), unit(random), unit(random)}, unit(random)}});
  }
  std::iota(sorted.begin(), sorted.end(), 0U);
  std::ranges::sort(sorted, {}, [&](std::uint32_t s) { return list.segments[s].front; });
  for (const std::uint32_t s : sorted) {
    const std::size_t p = list.segments[s].pixel;
    expected->red[p] += expected->transparency[p] * list.segments[s].light.rgb[0];
    expected->green[p] += expected->transparency[p] * list.segments[s].light.rgb[1];
    expected->blue[p] += expected->transparency[p] * list.segments[s].light.rgb[2];
    expected->transparency[p] *= list.segments[s].light.transparency;
    expected->last[p] = std::max(expected->last[p], list.segments[s].back);
  }
  TileCounts counts;
  composite_sorted(list, 1e9, *buffer, counts);
  EXPECT_EQ(counts.violations, 0U);
  EXPECT_EQ(buffer->red, expected->red);
  EXPECT_EQ(buffer->green, expected->green);
  EXPECT_EQ(buffer->blue, expected->blue);
  EXPECT_EQ(buffer->transparency, expected->transparency);
  EXPECT_EQ(buffer->last, expected->last);
}

}  // namespace
}  // namespace hiac
