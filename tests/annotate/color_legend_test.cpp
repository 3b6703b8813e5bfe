#include "hiac/annotate/color_legend.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "hiac/annotate/annotate.hpp"
#include "hiac/annotate/ticks.hpp"
#include "hiac/base/error.hpp"
#include "hiac/image/srgb.hpp"
#include "tests/annotate/annotated_scene.hpp"

namespace hiac {
namespace {

using test::colored_scene;
using Place = AnnotationPlace;

const Lettering kLettering{18};

ColorBarAnnotation bar_at(Place place, bool logarithmic) {
  ColorBarAnnotation bar;
  bar.place = place;
  bar.logarithmic = logarithmic;
  return bar;
}

Scene scene_of(bool logarithmic) {
  Scene scene = colored_scene({800, 600});
  if (logarithmic)
    scene.volume.color = {"t", {{0.02, {0, 0.1, 1}}, {5, {0.6, 0.5, 0.4}}, {300, {1, 2, 0}}}};
  return scene;
}

/// The value at a share of the bar, from its lower end.
double value_at(double t, bool logarithmic) {
  return logarithmic ? 0.02 * std::pow(300 / 0.02, t) : -2 + 5 * t;
}

TEST(ColorLegend, ShowsTheMapsColours) {
  for (const bool logarithmic : {false, true})
    for (const Place place : {Place::right, Place::left, Place::top, Place::bottom}) {
      const Scene scene = scene_of(logarithmic);
      const ColorBarAnnotation bar = bar_at(place, logarithmic);
      // as a picture shows it: stamped on grey and stored in 8 bits
      Annotation annotation;
      annotation.color_bar = bar;
      const Annotator annotator(annotation, scene, {"t", ""});
      Image picture(800, 600, rgba_channels());
      std::ranges::fill(picture.values(), 0.25);
      annotator.draw(picture, {0, 0, 800, 600}, true);
      const PixelBox& outer = annotator.boxes()[0];
      const LegendLayout box = legend_layout(bar, scene, "t", kLettering);
      const bool upright = place == Place::right || place == Place::left;
      const int length = upright ? box.height : box.width;
      EXPECT_EQ(length, 300);
      const auto function = scene.volume.color->function();
      for (int k = 0; k < length; ++k) {
        const Color expected = function(value_at((k + 0.5) / length, logarithmic));
        const auto x = static_cast<std::size_t>(outer.x + box.x + (upright ? box.width / 2 : k));
        const auto y = static_cast<std::size_t>(outer.y + box.y +
                                                (upright ? box.height - 1 - k : box.height / 2));
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(srgb_encode(picture.at(x, y, c)), srgb_encode(std::min(expected[c], 1.0)),
                      0.5 / 255)
              << k;
      }
    }
}

/// Rows (upright) or columns in which there is a tick beside the bar.
std::vector<int> ticks_in(const Canvas& canvas, const LegendLayout& box, bool upright) {
  std::vector<int> found;
  const int at = upright ? box.x + box.width + 3 : box.y + box.height + 3;
  const int most = upright ? canvas.height() : canvas.width();
  for (int k = 0; k < most; ++k) {
    const double alpha = upright ? test::alpha(canvas, at, k) : test::alpha(canvas, k, at);
    if (alpha > 0.3) found.push_back(k);
  }
  return found;
}

TEST(ColorLegend, HasTicksWhereTheNumbersAre) {
  for (const bool logarithmic : {false, true})
    for (const Place place : {Place::right, Place::top}) {
      const bool upright = place == Place::right;
      const Scene scene = scene_of(logarithmic);
      const ColorBarAnnotation bar = bar_at(place, logarithmic);
      const Canvas canvas = test::drawn(color_legend(bar, scene, "t", kLettering));
      const LegendLayout box = legend_layout(bar, scene, "t", kLettering);
      // by trying all places on the bar: those nearest to the round numbers
      const std::vector<double> numbers = logarithmic ? std::vector<double>{0.1, 1, 10, 100}
                                                      : std::vector<double>{-2, -1, 0, 1, 2, 3};
      const std::vector<int> found = ticks_in(canvas, box, upright);
      EXPECT_GE(found.size(), numbers.size());
      EXPECT_LE(found.size(), 2 * numbers.size());
      const int length = upright ? box.height : box.width;
      for (const double number : numbers) {
        int nearest = 0;
        for (int k = 0; k <= length; ++k)
          if (std::abs(value_at(double(k) / length, logarithmic) - number) <
              std::abs(value_at(double(nearest) / length, logarithmic) - number))
            nearest = k;
        const int there = upright ? box.y + box.height - nearest : box.x + nearest;
        const bool is_there = std::ranges::any_of(
            found, [&](int tick) { return std::abs(tick + 0.5 - there) <= 1.01; });
        EXPECT_TRUE(is_there) << number;
      }
    }
}

double ink_in(const Canvas& canvas, int x0, int y0, int x1, int y1) {
  double sum = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) sum += test::alpha(canvas, x, y);
  return sum;
}

// At 18 pixels an em: a halo of 2, lines of 1, a bar 20 thick, ticks of 5 with 5 behind them, and
// lines of text 22 high.
TEST(ColorLegend, HasRoomForItsPartsAndNoMore) {
  const Scene scene = scene_of(false);
  const int numbers = static_cast<int>(std::ceil(Text(18).width(typeset("-2"))));
  for (const std::string label : {"", "t"})
    for (const Place place : {Place::right, Place::left, Place::top, Place::bottom}) {
      const bool upright = place == Place::right || place == Place::left;
      const AnnotationPart part = color_legend(bar_at(place, false), scene, label, kLettering);
      const LegendLayout box = legend_layout(bar_at(place, false), scene, label, kLettering);
      const int for_label = label.empty() ? 0 : 22 + 5;
      EXPECT_EQ(part.name, "colorbar");
      EXPECT_EQ(part.place, place);
      if (upright) {
        EXPECT_EQ(box.x, 2 + 1);
        EXPECT_EQ(box.y, 2 + 11);  // half a number stands above the bar
        EXPECT_EQ(box.width, 20);
        EXPECT_EQ(box.height, 300);
        EXPECT_EQ(part.width, 3 + 20 + 1 + 5 + 5 + numbers + for_label + 2);
        EXPECT_EQ(part.height, 300 + 2 * 13);
      } else {
        EXPECT_EQ(box.x, 2 + (numbers + 1) / 2);
        EXPECT_EQ(box.y, 2 + for_label + 1);
        EXPECT_EQ(box.width, 300);
        EXPECT_EQ(box.height, 20);
        EXPECT_EQ(part.width, 300 + 2 * box.x);
        EXPECT_EQ(part.height, box.y + 20 + 1 + 5 + 22 + 2);
      }
    }
}

/// The first and the last row (or column) with ink in a part of a canvas.
std::array<int, 2> inked_rows(const Canvas& canvas, const PixelBox& part, bool columns = false) {
  int first = 10000, last = -1;
  for (auto y = part.y; y < part.y + part.height; ++y)
    for (auto x = part.x; x < part.x + part.width; ++x)
      if (test::alpha(canvas, static_cast<int>(x), static_cast<int>(y)) > 0.2) {
        first = std::min(first, static_cast<int>(columns ? x : y));
        last = std::max(last, static_cast<int>(columns ? x : y));
      }
  return {first, last};
}

TEST(ColorLegend, PutsNumbersAndLabelBesideTheBarAndItsTicks) {
  const Scene scene = scene_of(false);
  const auto bar = [](Place place) { return bar_at(place, false); };
  const Canvas upright = test::drawn(color_legend(bar(Place::right), scene, "HHH", kLettering));
  // ticks are 5 long and a pixel thick, behind the frame; the upmost one is half above the bar
  for (int x = 23; x < 31; ++x) {
    const double expected = x == 23 ? 1 : x < 24 + 5 ? 0.5 : 0;
    EXPECT_NEAR(test::alpha(upright, x, 12), expected, 1e-9) << x;
  }
  // its number is as high as the tick's place, 13, is in the middle of its digits
  const auto [top, bottom] = inked_rows(upright, {34, 0, 20, 40});
  EXPECT_NEAR((top + bottom + 1) / 2.0, 13, 1);
  EXPECT_NEAR(inked_rows(upright, {29, 0, 10, 40}, true)[0], 35, 1.5);
  // the label runs upwards in the middle of the bar, at the right edge but for what descends
  const int left = upright.width() - 2 - 22;
  const auto [from, to] = inked_rows(upright, {left, 0, 24, 326});
  EXPECT_NEAR((from + to + 1) / 2.0, 163, 1);
  EXPECT_EQ(inked_rows(upright, {left, 0, 24, 326}, true)[1], upright.width() - 2 - 5 - 1);
  const Canvas level = test::drawn(color_legend(bar(Place::bottom), scene, "HHH", kLettering));
  const LegendLayout box = legend_layout(bar(Place::bottom), scene, "HHH", kLettering);
  for (int y = box.y + 20; y < box.y + 28; ++y) {
    const int below = y - box.y - 20;
    const double expected = below == 0 ? 1 : below <= 5 ? 0.5 : 0;
    EXPECT_NEAR(test::alpha(level, box.x - 1, y), expected, 1e-9) << y;
  }
  // the 1 stands on its line's baseline, the label on that of the first line
  const PixelBox one{box.x + 180 - 8, box.y + 27, 16, 23};
  EXPECT_EQ(inked_rows(level, one)[1], box.y + 20 + 1 + 5 + 17 - 1);
  const auto [start, end] = inked_rows(level, {0, 0, level.width(), 24}, true);
  EXPECT_NEAR((start + end + 1) / 2.0, level.width() / 2.0, 1);
  EXPECT_EQ(inked_rows(level, {0, 0, level.width(), 24})[1], 2 + 17 - 1);
}

TEST(ColorLegend, LeavesNumbersApart) {
  // -2, -1 ... 3 stand 1.6 em apart or more, six of them on more than 144 pixels; below that -2, 0,
  // 2
  for (const auto& [pixels, count] : {std::pair(144.0, 3), {145.0, 6}}) {
    ColorBarAnnotation bar = bar_at(Place::right, false);
    bar.size = {pixels, true};
    const Scene scene = scene_of(false);
    const Canvas canvas = test::drawn(color_legend(bar, scene, "", kLettering));
    int ticks = 0;
    for (int y = 1; y < canvas.height(); ++y)
      if (test::alpha(canvas, 26, y) > 0 && test::alpha(canvas, 26, y - 1) == 0) ++ticks;
    EXPECT_EQ(ticks, count) << pixels;
  }
}

TEST(ColorLegend, HasNumbersAndALabel) {
  const Scene scene = scene_of(false);
  for (const Place place : {Place::right, Place::bottom}) {
    const bool upright = place == Place::right;
    const ColorBarAnnotation bar = bar_at(place, false);
    const AnnotationPart bare = color_legend(bar, scene, "", kLettering);
    const AnnotationPart named = color_legend(bar, scene, "temperature (K)", kLettering);
    const Canvas with = test::drawn(named), without = test::drawn(bare);
    EXPECT_EQ(upright ? named.height : named.width, upright ? bare.height : bare.width);
    const int more = upright ? named.width - bare.width : named.height - bare.height;
    EXPECT_GE(more, 18);
    EXPECT_LE(more, 30);
    const double letters = ink_in(with, 0, 0, with.width(), with.height()) -
                           ink_in(without, 0, 0, without.width(), without.height());
    EXPECT_GT(letters, 300);
    EXPECT_LT(letters, 2000);
    // the numbers
    const LegendLayout box = legend_layout(bar, scene, "", kLettering);
    const double numbers =
        upright ? ink_in(without, box.x + box.width + 8, 0, without.width(), without.height())
                : ink_in(without, 0, box.y + box.height + 8, without.width(), without.height());
    EXPECT_GT(numbers, 150);
  }
}

TEST(ColorLegend, KeepsALongLabelInItsPart) {
  const Scene scene = scene_of(false);
  for (const Place place : {Place::right, Place::bottom}) {
    const AnnotationPart part =
        color_legend(bar_at(place, false), scene, std::string(300, 'W'), kLettering);
    const Canvas canvas = test::drawn(part);
    const int halo = kLettering.halo();
    for (int y = 0; y < canvas.height(); ++y)
      for (int x = 0; x < canvas.width(); ++x)
        if (x < halo - 1 || y < halo - 1 || x > canvas.width() - halo ||
            y > canvas.height() - halo) {
          EXPECT_EQ(test::alpha(canvas, x, y), 0) << x << " " << y;
        }
  }
}

TEST(ColorLegend, RefusesALogarithmOfZero) {
  EXPECT_THAT([] { color_legend(bar_at(Place::right, true), scene_of(false), "t", kLettering); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr(
                  "key `annotation.colorbar.scale`: a logarithmic bar needs positive scalars")));
}

TEST(ColorLegend, DrawsRangesOfAnySize) {
  const std::pair<double, double> ranges[] = {
      {1, 1 + 0x1p-52}, {-1e100, 1e100}, {0, 1e-99}, {3, 3}, {0, 0}, {1e99, 1.0000001e99}};
  for (const auto& [low, high] : ranges) {
    Scene scene = colored_scene({800, 600});
    scene.volume.color = {"t", {{low, {0, 0, 0}}, {high, {1, 1, 1}}}};
    const ColorBarAnnotation bar = bar_at(Place::right, low > 0);
    const Canvas canvas = test::drawn(color_legend(bar, scene, "", kLettering));
    const LegendLayout box = legend_layout(bar, scene, "", kLettering);
    EXPECT_GT(ink_in(canvas, box.x + box.width + 8, 0, canvas.width(), canvas.height()), 60) << low;
  }
}

}  // namespace
}  // namespace hiac
