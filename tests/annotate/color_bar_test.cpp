#include "hiac/annotate/color_bar.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "hiac/annotate/text.hpp"
#include "hiac/base/error.hpp"
#include "hiac/scene/colormaps/color_space.hpp"
#include "hiac/scene/specification.hpp"

namespace hiac {
namespace {

using Layout = ColorBarLayout;

Volume volume_of_one_field() {
  Volume volume;
  volume.color = {"t", {{0, {0, 0.25, 2}}, {4, {1, 0.25, 2}}}};
  volume.extinction = {"t", {{1, {0.5}}, {2, {0.5}}, {2, {3}}, {5, {3}}}};
  return volume;
}

/// The value that column i of a part shows.
double value_at(int i, double low, double high) {
  const double t = (i + 0.5) / Layout::kPlotWidth;
  return (1 - t) * low + t * high;
}

constexpr int kBarTop = Layout::kMargin + Layout::kTitleHeight;
constexpr int kPartHeight =
    Layout::kTitleHeight + Layout::kBarHeight + Layout::kTicksHeight + Layout::kMargin;
constexpr int kGraphTop = kBarTop + kPartHeight;

std::span<const double> pixel(const Image& image, int x, int y) {
  return image.pixel(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
}

TEST(ColorBar, ShowsTheColoursOfItsColumns) {
  const Volume volume = volume_of_one_field();
  const Image bar = draw_color_bar(volume, {"t", "t"}, 0.5);
  EXPECT_EQ(bar.width(), static_cast<std::size_t>(Layout::kWidth));
  const auto function = volume.color->function();
  for (int i = 0; i < Layout::kPlotWidth; ++i)
    for (const int y : {kBarTop, kBarTop + Layout::kBarHeight - 1}) {
      const Color expected = function(value_at(i, 0, 5));
      const auto found = pixel(bar, Layout::kLeft + i, y);
      EXPECT_NEAR(found[0], expected[0], 1e-8);  // what encoding and decoding leave
      EXPECT_NEAR(found[1], 0.25, 1e-8);
      EXPECT_NEAR(found[2], 1, 1e-8);
    }
}

// Display values that are even in the logarithm are even along a logarithmic bar.
TEST(ColorBar, ShowsDisplayValuesEvenlyOnALogarithmicScale) {
  const ParsedScene parsed = parse_scene(
      "[image]\nwidth = 4\nheight = 3\n[camera]\neye = [0, -3, 1]\nlook_at = [0, 0, 0]\n"
      "up = [0, 0, 1]\nfov = 30\n[volume.color]\nfield = 't'\nscale = 'log'\n"
      "color_space = 'srgb'\npoints = [[0.01, 0, 0, 0.5], [100, 1, 0, 0.5]]\n"
      "[volume.extinction]\nfield = 'p'\npoints = [[0, 1]]\n",
      "view.toml");
  const Image bar =
      draw_color_bar(parsed.scene.volume, {"t", "p"}, 0.5, parsed.annotation.bar_is_logarithmic);
  for (int i = 0; i < Layout::kPlotWidth; ++i) {
    const auto found = pixel(bar, Layout::kLeft + i, kBarTop);
    EXPECT_NEAR(color_space::gamma_encoded(found[0]), (i + 0.5) / Layout::kPlotWidth, 0.006) << i;
    EXPECT_NEAR(color_space::gamma_encoded(found[2]), 0.5, 0.002) << i;
  }
}

TEST(ColorBar, ShowsTheOpacityOfTheLength) {
  const Volume volume = volume_of_one_field();
  const Image bar = draw_color_bar(volume, {"t", "t"}, 0.5);
  for (int i = 0; i < Layout::kPlotWidth; i += 13) {
    const double extinction = value_at(i, 0, 5) < 2 ? 0.5 : 3;
    const double opacity = 1 - std::exp(-extinction * 0.5);
    int shaded = 0;  // pixels below the curve, the last one in part
    for (int y = 0; y < Layout::kGraphHeight; ++y)
      shaded += pixel(bar, Layout::kLeft + i, kGraphTop + y)[0] < 0.999 ? 1 : 0;
    EXPECT_EQ(shaded, static_cast<int>(std::ceil(opacity * Layout::kGraphHeight))) << i;
  }
}

double ink_between(const Image& bar, int top, int bottom) {
  double sum = 0;
  for (int y = top; y < bottom; ++y)
    for (int x = 0; x < Layout::kWidth; ++x) sum += 1 - pixel(bar, x, y)[0];
  return sum;
}

TEST(ColorBar, NamesItsFieldsAndNumbersItsTicks) {
  const Image bar = draw_color_bar(volume_of_one_field(), {"t", "t"}, 0.5);
  const Image named = draw_color_bar(volume_of_one_field(), {"temperature (K)", "t"}, 0.5);
  EXPECT_GT(ink_between(named, 0, kBarTop - 2), 5 * ink_between(bar, 0, kBarTop - 2));
  const int below = kBarTop + Layout::kBarHeight;
  EXPECT_GT(ink_between(bar, below + 10, below + Layout::kTicksHeight), 100);
  // ticks of 0 ... 5 stand at sixth columns
  for (int value = 0; value < 5; ++value)
    EXPECT_LT(pixel(bar, Layout::kLeft + value * Layout::kPlotWidth / 5, below + 4)[0], 0.1);
}

TEST(ColorBar, LeavesOutWhatTheVolumeDoesNotHave) {
  Volume volume = volume_of_one_field();
  const std::size_t both = draw_color_bar(volume, {"t", "t"}, 1).height();
  Volume colors = volume;
  colors.extinction.reset();
  EXPECT_EQ(draw_color_bar(colors, {"t", ""}, 1).height(),
            static_cast<std::size_t>(Layout::kMargin + kPartHeight));
  volume.color.reset();
  EXPECT_LT(draw_color_bar(volume, {"", "t"}, 1).height(), both);
  volume.extinction.reset();
  EXPECT_THROW(draw_color_bar(volume, {}, 1), UsageError);
}

TEST(ColorBar, DrawsRangesOfAnySize) {
  const std::pair<double, double> ranges[] = {{1, 1 + 0x1p-52},       {-1e308, 1e308},  {0, 1e-320},
                                              {1e-300, 1e-289},       {1e15, 1e15 + 1}, {-0.0, 0.0},
                                              {1e308, 1.0000001e308}, {-1e-12, 1}};
  for (const auto& [low, high] : ranges) {
    Volume volume;
    volume.color = {"t", {{low, {0, 0, 0}}, {high, {1, 1, 1}}}};
    const Image bar = draw_color_bar(volume, {"t", ""}, 1);
    const int below = kBarTop + Layout::kBarHeight;
    EXPECT_GT(ink_between(bar, below + 10, below + Layout::kTicksHeight), 100)
        << low << " " << high;
  }
}

TEST(ColorBar, IsEvenInTheLogarithmIfItIsToBe) {
  Volume volume;
  volume.color = {"t", {{1, {0, 0, 0}}, {100, {0.9, 0.45, 0.1}}}};
  volume.extinction = {"t", {{0, {0}}, {100, {1}}}};  // no logarithm goes down to 0
  const Image bar = draw_color_bar(volume, {"t", "t"}, 1, true);
  const auto function = volume.color->function();
  for (int i = 0; i < Layout::kPlotWidth; i += 9) {
    const Color expected = function(std::pow(100, (i + 0.5) / Layout::kPlotWidth));
    const auto found = pixel(bar, Layout::kLeft + i, kBarTop + 3);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-8) << i;
  }
  // the decades 1, 10 and 100, in the middle the second of them
  const int below = kBarTop + Layout::kBarHeight + 4;
  for (const int column : {0, Layout::kPlotWidth / 2, Layout::kPlotWidth - 1})
    EXPECT_LT(pixel(bar, Layout::kLeft + column, below)[0], 0.1) << column;
  volume.color->points[0].scalar = 0;
  EXPECT_THROW(draw_color_bar(volume, {"t", "t"}, 1, true), InputError);
}

TEST(ColorBar, DrawsFunctionsThatAreTheSameEverywhere) {
  for (const double scalar : {0.0, -3.5, 1e10}) {
    Volume volume;
    volume.color = {"t", {{scalar, {0.5, 0.5, 0.5}}}};
    volume.extinction = {"t", {{scalar, {1e300}}}};
    const Image bar = draw_color_bar(volume, {"t", "t"}, 1);
    EXPECT_NEAR(pixel(bar, Layout::kLeft + 7, kBarTop)[0], 0.5, 1e-8);
    EXPECT_LT(pixel(bar, Layout::kLeft + 7, kGraphTop)[0], 0.5);  // opaque
  }
}

/// The first and the last row with ink in a part of a bar, and of that the darkest.
struct Inked {
  int first = 10000, last = -1;
};
Inked inked_in(const Image& bar, int x0, int x1, int y0, int y1, bool columns = false) {
  Inked found;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      if (pixel(bar, x, y)[0] < 0.5) {
        found.first = std::min(found.first, columns ? x : y);
        found.last = std::max(found.last, columns ? x : y);
      }
  return found;
}

// Titles are 22 pixels an em, numbers 18; capitals and digits are 0.73 em high.
TEST(ColorBar, WritesTitlesAndNumbersWhereTheyBelong) {
  Volume volume;
  volume.color = {"H", {{0, {1, 1, 1}}, {1, {1, 1, 1}}}};
  volume.extinction = {"H", {{0, {0}}, {1, {0}}}};
  const Image bar = draw_color_bar(volume, {"H", "H"}, 1);
  const Inked title = inked_in(bar, 0, Layout::kWidth, 0, kBarTop - 2);
  EXPECT_EQ(title.last, Layout::kMargin + 30 - 1);  // stands on its baseline
  EXPECT_NEAR(title.last + 1 - title.first, 0.73 * 22, 1.01);
  const Inked left = inked_in(bar, 0, Layout::kWidth, 0, kBarTop - 2, true);
  EXPECT_NEAR(left.first, Layout::kLeft + 2, 1);
  // 0.0 below the left end, 1.0 below the right one, both around their tick of seven pixels
  const int below = kBarTop + Layout::kBarHeight;
  for (const int end : {Layout::kLeft, Layout::kLeft + Layout::kPlotWidth - 1}) {
    const Inked tick = inked_in(bar, end, end + 1, below + 1, below + 12);
    EXPECT_EQ(tick.first, below + 1);
    EXPECT_EQ(tick.last, below + 7);
    const Inked number = inked_in(bar, end - 30, end + 30, below + 10, below + 38);
    EXPECT_NEAR(number.last, below + 28 - 1, 1);
    EXPECT_NEAR(number.last + 1 - number.first, 0.74 * 18, 1.51);
    const Inked across = inked_in(bar, end - 30, end + 30, below + 10, below + 38, true);
    EXPECT_NEAR((across.first + across.last + 1) / 2.0, end + 0.5, 1.6);
  }
  // the scale of the graph: lines at 0, 0.5 and 1, and their numbers to the left
  for (const int y : {kGraphTop, kGraphTop + 60, kGraphTop + 120}) {
    for (int x = Layout::kLeft - 10; x < Layout::kLeft; ++x)
      EXPECT_EQ(pixel(bar, x, y)[0] < 0.2, x >= Layout::kLeft - 8) << x << " " << y;
    const Inked number = inked_in(bar, 10, Layout::kLeft - 11, y - 14, y + 9);
    EXPECT_NEAR(number.last, y + 6 - 1, 1);
    const Inked across = inked_in(bar, 10, Layout::kLeft - 11, y - 14, y + 9, true);
    EXPECT_NEAR(across.last, Layout::kLeft - 12 - 1.5, 2);
  }
  // frames of one pixel around both
  for (const int y : {kBarTop - 1, below, kGraphTop - 1, kGraphTop + Layout::kGraphHeight})
    EXPECT_NEAR(pixel(bar, Layout::kLeft + 100, y)[0], 0.0508761, 1e-6) << y;
  for (const int x : {Layout::kLeft - 1, Layout::kLeft + Layout::kPlotWidth})
    for (const int y : {kBarTop + 10, kGraphTop + 10})
      EXPECT_NEAR(pixel(bar, x, y)[0], 0.0508761, 1e-6) << x;
}

TEST(ColorBar, SaysWhatGlowsAndOverWhichLengthItAbsorbs) {
  // the titles' widths, as their words would be written
  Volume volume;
  volume.color = {"t", {{0, {1, 1, 1}}, {1, {1, 1, 1}}}};
  volume.extinction = {"t", {{0, {0}}, {1, {0}}}};
  const auto width = [](const Image& bar, int top) {
    const Inked columns = inked_in(bar, Layout::kLeft, Layout::kWidth, top, top + 40, true);
    return columns.last + 1 - columns.first;
  };
  const Text titles(22);
  const Image bar = draw_color_bar(volume, {"t", "t"}, 0.25);
  EXPECT_NEAR(width(bar, Layout::kMargin), titles.width("t"), 3);
  EXPECT_NEAR(width(bar, Layout::kMargin + kPartHeight),
              titles.width("t: opacity over a length of 0.25"), 4);
  volume.glow = Glow::emission;
  EXPECT_NEAR(width(draw_color_bar(volume, {"t", "t"}, 0.25), Layout::kMargin),
              titles.width("t: emission per unit of length"), 4);
  // a long title ends at the margin
  const Image wide = draw_color_bar(volume, {std::string(200, 'H'), "t"}, 0.25);
  EXPECT_LE(inked_in(wide, 0, Layout::kWidth, 0, 50, true).last, Layout::kWidth - Layout::kMargin);
  EXPECT_GE(inked_in(wide, 0, Layout::kWidth, 0, 50, true).last,
            Layout::kWidth - Layout::kMargin - 40);
}

}  // namespace
}  // namespace hiac
