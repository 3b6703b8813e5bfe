#include "hiac/annotate/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>

#include "hiac/image/srgb.hpp"
#include "tests/annotate/annotated_scene.hpp"

namespace hiac {
namespace {

constexpr Color kRed{1, 0, 0}, kBlue{0, 0, 1};

/// The alpha of every pixel, row by row, with a digit each: tenths, rounded.
std::vector<std::string> rows_of(const Canvas& canvas) {
  std::vector<std::string> rows;
  for (int y = 0; y < canvas.height(); ++y) {
    rows.emplace_back();
    for (int x = 0; x < canvas.width(); ++x)
      rows.back() += ".123456789X"[std::lround(10 * test::alpha(canvas, x, y))];
  }
  return rows;
}

using Rows = std::vector<std::string>;

TEST(Canvas, MixesInkOnPaperByItsShare) {
  Canvas canvas(2, 1, kRed);
  canvas.blend(0, 0, kBlue, 0.25);
  EXPECT_DOUBLE_EQ(canvas.image().at(0, 0, 0), 0.75);
  EXPECT_DOUBLE_EQ(canvas.image().at(0, 0, 2), 0.25);
  EXPECT_EQ(canvas.image().at(0, 0, 3), 1);
  EXPECT_EQ(canvas.image().at(1, 0, 0), 1);
}

TEST(Canvas, KeepsTheColourOfInkThatIsThin) {
  Canvas canvas(1, 1);
  canvas.blend(0, 0, kRed, 0.5);
  EXPECT_EQ(canvas.image().at(0, 0, 0), 1);  // straight: not darkened by what is clear
  EXPECT_EQ(canvas.image().at(0, 0, 3), 0.5);
  canvas.blend(0, 0, kBlue, 0.5);  // a half of it, and a quarter of what was there
  EXPECT_DOUBLE_EQ(canvas.image().at(0, 0, 3), 0.75);
  EXPECT_DOUBLE_EQ(canvas.image().at(0, 0, 0), 1.0 / 3);
  EXPECT_DOUBLE_EQ(canvas.image().at(0, 0, 2), 2.0 / 3);
}

TEST(Canvas, LeavesOutWhatIsBesideIt) {
  Canvas canvas(3, 2);
  for (std::int64_t y = -2; y <= 3; ++y)
    for (std::int64_t x = -2; x <= 4; ++x)
      if (x < 0 || y < 0 || x > 2 || y > 1) canvas.blend(x, y, kRed, 1);
  EXPECT_EQ(rows_of(canvas), (Rows{"...", "..."}));
  for (const double none : {0.0, -1.0, std::nan("")}) canvas.blend(1, 1, kRed, none);
  EXPECT_EQ(rows_of(canvas), (Rows{"...", "..."}));
  EXPECT_EQ(canvas.image().at(1, 1, 0), 0);
  canvas.fill(-5, -5, 20, 20, kRed);
  EXPECT_EQ(rows_of(canvas), (Rows{"XXX", "XXX"}));
}

TEST(Canvas, FramesABoxFromOutside) {
  Canvas canvas(7, 6);
  canvas.fill(1, 4, 2, 1, kRed);
  EXPECT_EQ(rows_of(canvas),
            (Rows{".......", ".......", ".......", ".......", ".XX....", "......."}));
  Canvas thin(7, 6);
  thin.frame(2, 1, 3, 2, 1, kRed);
  EXPECT_EQ(rows_of(thin),
            (Rows{".XXXXX.", ".X...X.", ".X...X.", ".XXXXX.", ".......", "......."}));
  Canvas thick(7, 6);
  thick.frame(2, 2, 3, 1, 2, kRed);
  EXPECT_EQ(rows_of(thick),
            (Rows{"XXXXXXX", "XXXXXXX", "XX...XX", "XXXXXXX", "XXXXXXX", "......."}));
}

TEST(Canvas, FillsPixelsByTheAreaOfARectangle) {
  Canvas canvas(5, 4);
  canvas.rectangle({1.25, 0.5}, {3.5, 2.75}, kRed);
  const double columns[] = {0, 0.75, 1, 0.5, 0}, rows[] = {0.5, 1, 0.75, 0};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x)
      EXPECT_DOUBLE_EQ(test::alpha(canvas, x, y), columns[x] * rows[y]) << x << " " << y;
  Canvas narrow(3, 3);
  narrow.rectangle({1.25, 1}, {1.5, 2}, kRed);  // within one pixel
  EXPECT_EQ(test::alpha(narrow, 1, 1), 0.25);
  EXPECT_EQ(rows_of(narrow), (Rows{"...", ".3.", "..."}));  // nothing but that pixel
  Canvas cut(2, 2);
  cut.rectangle({-3.5, -2.5}, {0.5, 1}, kRed);
  EXPECT_EQ(rows_of(cut), (Rows{"5.", ".."}));
}

/// How far a point is from a segment, by trying many points of it.
double distance_by_trying(CanvasPoint p, CanvasPoint a, CanvasPoint b) {
  double least = 1e9;
  for (int k = 0; k <= 2000; ++k) {
    const double t = k / 2000.0;
    least = std::min(least, std::hypot(a.x + t * (b.x - a.x) - p.x, a.y + t * (b.y - a.y) - p.y));
  }
  return least;
}

TEST(Canvas, DrawsSegmentsWithRoundEnds) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-2, 12), thickness(0.5, 4);
  for (int trial = 0; trial < 12; ++trial) {
    CanvasPoint a{place(random), place(random)}, b{place(random), place(random)};
    if (trial == 0) b = a;  // a dot
    if (trial == 1) b.x = a.x;
    if (trial == 2) b.y = a.y;
    const double thick = thickness(random);
    Canvas canvas(10, 9);
    canvas.segment(a, b, thick, kRed);
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 10; ++x) {
        const double away = distance_by_trying({x + 0.5, y + 0.5}, a, b);
        EXPECT_NEAR(test::alpha(canvas, x, y), std::clamp(thick / 2 + 0.5 - away, 0.0, 1.0), 6e-3)
            << trial << ": " << x << " " << y;
      }
  }
}

TEST(Canvas, FillsPolygonsWithSoftEdges) {
  // a rectangle on whole pixels: half a pixel fades on either side of its edges
  Canvas box(6, 5);
  const CanvasPoint corners[] = {{1, 1}, {4, 1}, {4, 4}, {1, 4}};
  box.polygon(corners, kRed);
  EXPECT_EQ(rows_of(box), (Rows{"......", ".XXX..", ".XXX..", ".XXX..", "......"}));
  Canvas shifted(6, 5);
  const CanvasPoint by_a_quarter[] = {{1.25, 1.5}, {4.25, 1.5}, {4.25, 3.5}, {1.25, 3.5}};
  shifted.polygon(by_a_quarter, kRed);
  for (int x = 0; x < 6; ++x) {
    const double across[] = {0, 0.75, 1, 1, 0.25, 0};
    EXPECT_NEAR(test::alpha(shifted, x, 2), across[x], 1e-12) << x;
    EXPECT_NEAR(test::alpha(shifted, x, 1), std::min(0.5, across[x]), 1e-12) << x;
    EXPECT_NEAR(test::alpha(shifted, x, 3), std::min(0.5, across[x]), 1e-12) << x;
    EXPECT_EQ(test::alpha(shifted, x, 0), 0);
    EXPECT_EQ(test::alpha(shifted, x, 4), 0);
  }
  // a slanted edge by the distance from it, whatever its length
  Canvas slanted(8, 8);
  const CanvasPoint triangle[] = {{0, 0}, {8, 8}, {-8, 8}};
  slanted.polygon(triangle, kRed);
  for (int k = 0; k + 1 < 8; ++k) {
    EXPECT_NEAR(test::alpha(slanted, k, k), 0.5, 1e-12);
    EXPECT_EQ(test::alpha(slanted, k + 1, k), 0);  // 0.71 pixels beside the edge
    EXPECT_EQ(test::alpha(slanted, k, k + 1), 1);
  }
}

/// Columns or rows that have ink: the first and the one behind the last.
std::array<int, 2> inked(const Canvas& canvas, bool columns) {
  int first = 1000, end = 0;
  for (int y = 0; y < canvas.height(); ++y)
    for (int x = 0; x < canvas.width(); ++x)
      if (test::alpha(canvas, x, y) > 0) {
        first = std::min(first, columns ? x : y);
        end = std::max(end, (columns ? x : y) + 1);
      }
  return {first, end};
}

TEST(Canvas, WritesToTheRightOfAnAnchor) {
  const Text text(20);
  const double width = text.width("HIH");
  Canvas start(200, 60), middle(200, 60), end(200, 60);
  start.write(text, 40, 0, 40, "HIH", kRed);
  middle.write(text, 100, 0.5, 40, "HIH", kRed);
  end.write(text, 160, 1, 40, "HIH", kRed);
  // an H stands a tenth of an em from either end of its place
  const auto [a, b] = inked(start, true);
  EXPECT_NEAR(a, 42, 1);
  EXPECT_NEAR(b, 40 + width - 1.5, 1);
  const auto [c, d] = inked(middle, true);
  EXPECT_NEAR((c + d) / 2.0, 100, 1);
  EXPECT_NEAR(inked(end, true)[1], 160 - 1.5, 1);
  EXPECT_EQ(inked(start, false)[1], 40);  // stands on the baseline
  EXPECT_NEAR(inked(start, false)[0], 40 - 0.73 * 20, 1);
  EXPECT_EQ(start.image().at(static_cast<std::size_t>(a), 35, 0), 1);
}

TEST(Canvas, WritesUpwardsAQuarterTurned) {
  // what is written level, turned pixel by pixel
  const Text text(20);
  const std::string line = "Fjord 17";
  Canvas level(200, 60), upright(60, 200);
  level.write(text, 0, 0, 40, line, kRed);
  upright.write_upwards(text, 40, 100, line, kRed);
  const int start = static_cast<int>(std::lround(100 + text.width(line) / 2));
  int compared = 0;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 150; ++x) {
      if (start - 1 - x < 0) continue;
      EXPECT_EQ(test::alpha(upright, y, start - 1 - x), test::alpha(level, x, y)) << x << " " << y;
      compared += test::alpha(level, x, y) > 0 ? 1 : 0;
    }
  EXPECT_GT(compared, 200);
}

TEST(Canvas, IsLinearAsAPicture) {
  Canvas canvas(3, 2, {0.5, 0.25, 0.75});
  canvas.fill(2, 1, 1, 1, kBlue);
  const Image picture = canvas.linear();
  EXPECT_THAT(picture.channels(), testing::ElementsAre("R", "G", "B"));
  EXPECT_EQ(picture.width(), 3U);
  EXPECT_EQ(picture.height(), 2U);
  EXPECT_NEAR(picture.at(0, 0, 0), 0.21404114, 1e-8);
  EXPECT_NEAR(picture.at(0, 0, 1), 0.05087609, 1e-8);
  EXPECT_NEAR(picture.at(0, 0, 2), 0.52252155, 1e-8);
  EXPECT_EQ(picture.at(2, 1, 0), 0);
  EXPECT_EQ(picture.at(2, 1, 2), 1);
}

TEST(Canvas, TakesDisplayValuesOfColoursCutAtOne) {
  const Color found = display_color({0.21404114048223255, -0.5, 3});
  EXPECT_NEAR(found[0], 0.5, 1e-12);
  EXPECT_EQ(found[1], 0);
  EXPECT_NEAR(found[2], 1, 1e-12);
}

}  // namespace
}  // namespace hiac
