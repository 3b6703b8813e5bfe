// Runs of rays through parts of a mesh: folded of segments, sorted by depth and merged, against
// compositing every pixel's segments one by one.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/rounding.hpp"
#include "hiac/render/pixels/compositor.hpp"
#include "hiac/render/runs/merged_tile.hpp"
#include "hiac/render/runs/run_folder.hpp"
#include "hiac/render/runs/runs_by_depth.hpp"

namespace hiac {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr MergeConstants kMerge{1e-12, 0.25, 2, false};

std::unique_ptr<TileBuffer> empty_tile() {
  auto buffer = std::make_unique<TileBuffer>();
  buffer->transparency.fill(1);
  buffer->last.fill(-kNever);
  return buffer;
}

// The runs of segments in their order.
TileRuns folded(const std::vector<ListedSegment>& segments, bool apart = false,
                const std::vector<SegmentDetails>& details = {}, TileCounts counts = {}) {
  const auto buffer = empty_tile();
  RunFolder folder(*buffer, kMerge.witness_tolerance, !details.empty(), apart);
  for (std::size_t k = 0; k < segments.size(); ++k)
    folder.add(segments[k], details.empty() ? nullptr : &details[k]);
  return folder.take(counts);
}

ListedSegment segment(std::size_t pixel, double front, double back, double light,
                      double transparency) {
  return {pixel, front, back, {{light, 2 * light, 3 * light}, transparency}};
}

TEST(RunFolder, JoinsSegmentsThatMeet) {
  const TileRuns runs =
      folded({segment(7, 1, 2, 1, 0.5), segment(3, 0, 1, 8, 0.25), segment(7, 2, 4, 4, 0.5),
              segment(7, 5, 6, 16, 0.125), segment(7, 6, 7, 32, 0.5)});
  ASSERT_EQ(runs.runs.size(), 3U);
  EXPECT_TRUE(runs.facts.empty());
  const auto expect_run = [&](std::size_t k, std::uint32_t pixel, double front, double back,
                              double light, double transparency) {
    const RayRun& run = runs.runs[k];
    EXPECT_EQ(run.pixel, pixel);
    EXPECT_EQ(run.front, front);
    EXPECT_EQ(run.back, back);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(run.light.rgb[c], light * static_cast<double>(c + 1));
    EXPECT_EQ(run.light.transparency, transparency);
  };
  expect_run(0, 3, 0, 1, 8, 0.25);
  expect_run(1, 7, 1, 4, 1 + 0.5 * 4, 0.25);
  expect_run(2, 7, 5, 7, 16 + 0.125 * 32, 0.0625);
}

TEST(RunFolder, LeavesSegmentsApartWhereSplatsMayLieBetween) {
  const TileRuns runs = folded({segment(7, 1, 2, 1, 0.5), segment(7, 2, 4, 4, 0.5)}, true);
  ASSERT_EQ(runs.runs.size(), 2U);
  EXPECT_EQ(runs.runs[0].back, 2);
  EXPECT_EQ(runs.runs[1].front, 2);
  EXPECT_EQ(runs.runs[1].light.transparency, 0.5);
  EXPECT_EQ(runs.runs[1].light.rgb[0], 4);
}

// A run that begins before another one has ended, by more than the tolerance of 1/4, is counted,
// with what was counted before.
TEST(RunFolder, CountsRunsOutOfOrder) {
  const auto violations = [](double front) {
    return folded({segment(5, 0, 4, 1, 0.5), segment(5, front, 6, 1, 0.5)}, false, {}, {10, 100})
        .counts;
  };
  EXPECT_EQ(violations(3).violations, 101U);
  EXPECT_EQ(violations(3.75).violations, 100U);
  EXPECT_EQ(violations(5).violations, 100U);
  EXPECT_EQ(violations(3).segments, 10U);
}

// The facts of each of a pixel's runs are those of its segments alone.
TEST(RunFolder, DescribesEveryRunByItself) {
  std::vector<ListedSegment> segments{segment(7, 1, 2, 0, 1), segment(7, 2, 4, 1, 0.5),
                                      segment(7, 3, 6, 2, 0.25), segment(8, 1, 2, 1, 0.5)};
  std::vector<SegmentDetails> details;
  for (const ListedSegment& s : segments)
    details.push_back({.front = s.front,
                       .back = s.back,
                       .light = s.light.rgb[2],
                       .transparency = s.light.transparency,
                       .first = s.front + 0.125,
                       .mean = s.front + 0.5,
                       .radiance_error = 1e-3,
                       .transparency_error = 1e-4,
                       .front_edge = 0.01 * s.front,
                       .back_edge = 0.02 * s.back});
  const TileRuns runs = folded(segments, false, details);
  ASSERT_EQ(runs.facts.size(), 3U);
  // the first segment shows nothing, and the second one is behind it
  EXPECT_EQ(runs.facts[0].first, 2.125);
  EXPECT_EQ(runs.facts[0].mean, 2.5);
  EXPECT_EQ(runs.facts[0].cells, 2U);
  EXPECT_EQ(runs.facts[0].violations, 0U);
  EXPECT_EQ(runs.facts[0].front_edge, 0.01);
  EXPECT_NEAR(runs.facts[0].back_edge, 1.0001 * 0.02 * 4, 1e-12);
  // both segments, and what the first one's transparency is off times the second one's light
  EXPECT_NEAR(runs.facts[0].radiance_error, 1e-3 + 1.0001e-3 + 1e-4 * 3, 1e-12);
  EXPECT_NEAR(runs.facts[0].transparency_error, 1e-4 * 0.5 + 1.0001e-4, 1e-12);
  EXPECT_EQ(runs.facts[1].first, 3.125);
  EXPECT_EQ(runs.facts[1].mean, 3.5);
  EXPECT_EQ(runs.facts[1].cells, 1U);
  EXPECT_EQ(runs.facts[1].violations, 1U);
  EXPECT_EQ(runs.facts[1].front_edge, 0.03);
  EXPECT_NEAR(runs.facts[1].back_edge, 0.02 * 6, 1e-12);
  EXPECT_NEAR(runs.facts[1].radiance_error, 1e-3, 1e-12);
  EXPECT_EQ(runs.facts[2].cells, 1U);
  EXPECT_EQ(runs.counts.violations, 1U);
  // where nothing is opaque the mean depth is that of the run's beginning
  const TileRuns clear = folded({segment(7, 1, 2, 0, 1)}, false, {{.front = 1, .back = 2}});
  EXPECT_EQ(clear.facts[0].mean, 1);
  EXPECT_EQ(clear.facts[0].first, kNever);
}

// Segments of a tile's pixels, front to back in each: with gaps, and some that meet.
std::vector<ListedSegment> random_segments(std::mt19937_64& random, std::uint32_t pixels) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> reached(pixels, 0);
  std::vector<ListedSegment> segments;
  for (int k = 0; k < 2000; ++k) {
    const auto pixel = static_cast<std::uint32_t>(unit(random) * pixels);
    const double front = reached[pixel] + (random() % 2 == 0 ? 0 : unit(random));
    reached[pixel] = front + unit(random);
    segments.push_back({pixel,
                        front,
                        reached[pixel],
                        {{unit(random), unit(random), unit(random)}, 0.3 + 0.7 * unit(random)}});
  }
  return segments;
}

TEST(MergedTile, IsThePictureOfAllSegments) {
  std::mt19937_64 random(6);
  constexpr std::uint32_t kPixels = 300;
  const auto segments = random_segments(random, kPixels);
  // dealt out to three parts, stretch by stretch
  std::vector<std::vector<ListedSegment>> dealt(3);
  for (const ListedSegment& s : segments)
    dealt[static_cast<std::size_t>(s.front * 0.7 + static_cast<double>(s.pixel)) % 3].push_back(s);
  std::vector<TileRuns> parts;
  for (std::uint64_t k = 0; k < 3; ++k) parts.push_back(folded(dealt[k], false, {}, {10 * k, k}));
  const auto expected = empty_tile();
  TileCounts counts;
  for (const ListedSegment& s : segments)
    composite(s.pixel, s.front, s.back, s.light, 1e9, *expected, counts);
  MergedTile merged(kMerge, parts);
  for (std::uint32_t at = 0; at < kPixels; ++at) {
    EXPECT_NEAR(merged.pixels().red[at], expected->red[at], 1e-14);
    EXPECT_NEAR(merged.pixels().green[at], expected->green[at], 1e-14);
    EXPECT_NEAR(merged.pixels().blue[at], expected->blue[at], 1e-14);
    EXPECT_NEAR(merged.pixels().transparency[at], expected->transparency[at], 1e-14);
    EXPECT_EQ(merged.pixels().last[at], expected->last[at]);
    EXPECT_EQ(merged.surface_transparency(at), 1);
  }
  EXPECT_EQ(merged.counts().segments, 30U);
  EXPECT_EQ(merged.counts().violations, 3U);
}

// A ray ends with the first run that leaves no more than what counts.
TEST(MergedTile, EndsRaysAsTheEngineDoes) {
  MergeConstants constants = kMerge;
  constants.least_transparency = 0.125;
  const auto light = [&](double first) {
    const std::vector<TileRuns> parts{
        folded({segment(4, 0, 1, 0, first), segment(4, 3, 4, 16, 0.5)}),
        folded({segment(4, 1.5, 2, 0, 0.5)})};
    return MergedTile(constants, parts).pixels().red[4];
  };
  EXPECT_EQ(light(0.5), 0.25 * 16);
  EXPECT_EQ(light(0.25), 0);
  EXPECT_GT(light(0.2501), 0.125 * 16);
}

TEST(MergedTile, CountsRunsOutOfOrder) {
  MergeConstants constants = kMerge;
  constants.with_details = true;
  const auto merged = [&](double front) {
    std::vector<TileRuns> parts;
    for (const auto& [from, to] : {std::pair{0.0, 4.0}, {front, 6.0}}) {
      parts.push_back(folded({segment(4, from, to, 1, 0.5)}, false,
                             {{.front = from, .back = to, .light = 3, .transparency = 0.5}}));
    }
    return std::pair{MergedTile(constants, parts).counts().violations,
                     MergedTile(constants, parts).facts(4).violations};
  };
  EXPECT_EQ(merged(3), (std::pair{std::uint64_t{1}, 1U}));
  EXPECT_EQ(merged(3.75), (std::pair{std::uint64_t{0}, 0U}));
  EXPECT_EQ(merged(5), (std::pair{std::uint64_t{0}, 0U}));
}

// Facts and errors of segments in two parts are those of the same segments in one.
TEST(MergedTile, DescribesPixelsAsTheEngineDoes) {
  MergeConstants constants = kMerge;
  constants.with_details = true;
  const std::vector<ListedSegment> segments{
      segment(4, 1, 2, 0.01, 0.5), segment(4, 2, 4, 0.02, 0.5), segment(4, 5, 6, 0.03, 0.75)};
  std::vector<SegmentDetails> details;
  PixelDetails pixel;
  double visible = 1, light = 0;
  for (const ListedSegment& s : segments) {
    const auto number = static_cast<double>(details.size() + 1);
    details.push_back({.front = s.front,
                       .back = s.back,
                       .light = s.light.rgb[2],
                       .transparency = s.light.transparency,
                       .first = s.front,
                       .mean = s.front + 0.25,
                       .radiance_error = 1e-5 * number,
                       .transparency_error = 3e-6 * number,
                       .front_edge = 1e-3 * number,
                       .back_edge = 2e-3 * number});
    pixel.add(details.back(), visible, light);
    light += visible * s.light.rgb[2];
    visible *= s.light.transparency;
  }
  const std::vector<TileRuns> parts{
      folded({segments[2]}, false, {details[2]}),
      folded({segments[0], segments[1]}, false, {details[0], details[1]})};
  MergedTile merged(constants, parts);
  EXPECT_EQ(merged.facts(4).first, pixel.first);
  EXPECT_EQ(merged.facts(4).cells, 3U);
  EXPECT_NEAR(merged.facts(4).weighted_depth / merged.facts(4).weight,
              pixel.weighted_depth / pixel.weight, 1e-14);
  // the bounds of a run are composited first, which rounds, and adds products of errors
  for (const double background : {0.0, 0.5}) {
    const double expected = pixel.radiance_error + pixel.open_edge +
                            background * (pixel.transparency_error + pixel.open_edge);
    EXPECT_NEAR(merged.error(4, background), expected, 1e-3 * expected) << background;
  }
  // what lies behind the end of a ray
  constants.least_transparency = 0.25;
  MergedTile ended(constants, parts);
  EXPECT_EQ(ended.facts(4).cells, 2U);
  EXPECT_GT(ended.error(4, 0), 0.25 * 2);
}

// Where a run begins at the very end of another part's, nothing in between is in doubt.
TEST(MergedTile, DoubtsNoEndsAtWhichPartsMeet) {
  MergeConstants constants = kMerge;
  constants.with_details = true;
  const auto error = [&](double begin) {
    std::vector<TileRuns> parts;
    for (const auto& [from, to] : {std::pair{1.0, 2.0}, {begin, 5.0}})
      parts.push_back(folded({segment(4, from, to, 0.25, 0.5)}, false,
                             {{.front = from,
                               .back = to,
                               .light = 0.75,
                               .transparency = 0.5,
                               .front_edge = 1e-3,
                               .back_edge = 1e-4}}));
    return MergedTile(constants, parts).error(4, 0);
  };
  // What the first front hides too much or too little of, both runs' light lacks or has besides: of
  // the second run half is seen.
  const double light = 0.75, front = 1e-3, back = 0.5 * 1e-4;
  EXPECT_NEAR(error(2), front + front * light + 0.5 * front * light + back, 1e-6);
  // a gap: the first run's back and the second run's front, before the second run's light
  const double between = 1e-4 + 0.5 * 1e-3;
  EXPECT_NEAR(error(2.5) - error(2), between + between * light, 1e-5);
}

TEST(MergedTile, CoversWithTheSkinsOfAllParts) {
  std::vector<TileRuns> parts(3);
  parts[0].covers = {{4, 0.5}, {9, 0.75}};
  parts[2].covers = {{4, 0.25}};
  const MergedTile merged(kMerge, parts);
  EXPECT_EQ(merged.surface_transparency(4), 0.125);
  EXPECT_EQ(merged.surface_transparency(9), 0.75);
  EXPECT_EQ(merged.surface_transparency(5), 1);
}

TEST(RunsByDepth, AreSortedByPixelDepthAndPart) {
  std::mt19937_64 random(9);
  std::uniform_int_distribution<int> few(0, 3);
  std::vector<TileRuns> parts(3);
  using Key = std::tuple<std::uint32_t, double, double, std::uint32_t, std::uint32_t>;
  std::vector<Key> expected;
  for (std::uint32_t part = 0; part < 3; ++part)
    for (std::uint32_t run = 0; run < 200; ++run) {
      const double front = few(random);
      const auto pixel = static_cast<std::uint32_t>(
          run % 9 == 0 ? kTilePlane - 1 : static_cast<std::size_t>(few(random)));
      parts[part].runs.push_back({front, front + few(random), {}, pixel});
      const RayRun& added = parts[part].runs.back();
      expected.emplace_back(pixel, added.front, added.back, part, run);
    }
  std::ranges::sort(expected);
  const auto places = runs_by_depth(parts);
  ASSERT_EQ(places.size(), expected.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    EXPECT_EQ(places[k].part, std::get<3>(expected[k]));
    EXPECT_EQ(places[k].run, std::get<4>(expected[k]));
  }
}

// Three pixels of a tile, each of which ends with some run.
TEST(EndOfTile, IsWhereTheLastPixelEnds) {
  constexpr TileRect kTile{5, 2, 8, 3};
  constexpr double kLeast = 0.25;
  const auto run = [](int pixel, double front, double transparency) {
    return RayRun{front, front + 1, {{}, transparency}, static_cast<std::uint32_t>(pixel)};
  };
  std::vector<TileRuns> parts(2);
  parts[0].runs = {run(0, 1, 0.5), run(0, 7, 0.25), run(1, 3, 0.25), run(2, 2, 0.125)};
  parts[1].runs = {run(0, 4, 0.5), run(1, 9, 0.5)};
  EXPECT_EQ(end_of_tile(kTile, parts, kLeast), 4);
  // one that does not end; what has exactly as little left has ended
  parts[1].runs[0].light.transparency = 0.51;
  EXPECT_EQ(end_of_tile(kTile, parts, kLeast), 7);
  parts[0].runs[1].light.transparency = 1;
  EXPECT_EQ(end_of_tile(kTile, parts, kLeast), kNever);
  parts[1].runs[0].light.transparency = 0.5;
  parts[0].runs[3].light.transparency = 0.26;
  EXPECT_EQ(end_of_tile(kTile, parts, kLeast), kNever);
  // pixels beside the tile do not count
  EXPECT_EQ(end_of_tile({5, 2, 7, 3}, parts, kLeast), 4);
}

TEST(FirstEntry, IsTheNearestRuns) {
  TileRuns runs;
  EXPECT_EQ(first_entry(runs), kNever);
  runs.runs = {{3, 4, {}, 1}, {-2, 9, {}, 5}, {0, 1, {}, 0}};
  EXPECT_EQ(first_entry(runs), -2);
}

// Skins that are nearer to one another than both are off may have been swapped.
class SwappedSkinsTest : public testing::Test {
 protected:
  void add(std::size_t pixel, double front, RayPart part, double moved) {
    list_.segments.push_back({pixel, front, front, {}});
    SegmentDetails details{.front = front, .back = front, .part = part};
    details.radiance_error = 1e-9;
    details.transparency_error = 1e-9;
    details.moved = moved;
    details.in_doubt = 3;
    list_.details.push_back(details);
  }
  // Which segments are in doubt, in the order of the list.
  std::vector<bool> in_doubt() {
    std::vector<std::uint32_t> sorted(list_.segments.size());
    for (std::uint32_t k = 0; k < sorted.size(); ++k) sorted[k] = k;
    std::vector<bool> doubtful;
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      const SegmentDetails details = details_in_order(list_, sorted, k);
      EXPECT_EQ(details.radiance_error == 3, details.transparency_error == 1);
      doubtful.push_back(details.radiance_error == 3);
    }
    list_.clear();
    return doubtful;
  }

  SegmentList list_;
};

TEST_F(SwappedSkinsTest, AreInDoubt) {
  add(4, 1, RayPart::skin, 0.125);
  add(4, 1.25, RayPart::skin, 0.125);
  add(4, 2, RayPart::skin, 0.125);
  EXPECT_EQ(in_doubt(), (std::vector{true, true, false}));
  add(4, 1, RayPart::skin, 0.125);
  add(4, 1.25, RayPart::skin, 0.12);
  add(4, 1.25, RayPart::skin, 0);
  EXPECT_EQ(in_doubt(), (std::vector{false, true, true}));
}

TEST_F(SwappedSkinsTest, AreNeighboursInOnePixel) {
  add(4, 1, RayPart::skin, 1);
  add(5, 1, RayPart::skin, 1);
  EXPECT_EQ(in_doubt(), (std::vector{false, false}));
  add(4, 1, RayPart::skin, 1);
  add(4, 1, RayPart::inside, 1);
  add(4, 1, RayPart::skin, 1);
  EXPECT_EQ(in_doubt(), (std::vector{false, false, false}));
}

TEST_F(SwappedSkinsTest, AreNotKeptApartByEdges) {
  add(4, 1, RayPart::edge, 1);
  add(4, 1, RayPart::skin, 1);
  add(4, 1, RayPart::edge, 1);
  add(4, 1, RayPart::edge, 1);
  add(4, 1, RayPart::skin, 1);
  add(4, 1, RayPart::edge, 1);
  EXPECT_EQ(in_doubt(), (std::vector{false, true, false, false, true, false}));
}

TEST_F(SwappedSkinsTest, HaveErrorsThatMayBeLarger) {
  add(4, 1, RayPart::skin, 1);
  add(4, 1, RayPart::skin, 1);
  list_.details[0].radiance_error = 7;
  const std::vector<std::uint32_t> sorted{0, 1};
  EXPECT_EQ(details_in_order(list_, sorted, 0).radiance_error, 7);
  EXPECT_EQ(details_in_order(list_, sorted, 0).transparency_error, 1);
}

}  // namespace
}  // namespace hiac
