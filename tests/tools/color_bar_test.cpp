#include "tools/render/color_bar.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "tools/render/text.hpp"
#include "tools/render/ticks.hpp"

namespace hiac::tools {
namespace {

using Layout = ColorBarLayout;

std::vector<std::string> labels_of(const std::vector<Tick>& ticks) {
  std::vector<std::string> labels;
  for (const Tick& tick : ticks) labels.push_back(tick.label);
  return labels;
}

TEST(Ticks, AreRoundNumbersInTheRange) {
  using testing::ElementsAre;
  EXPECT_THAT(labels_of(round_ticks(0, 1, 7)),
              ElementsAre("0.0", "0.2", "0.4", "0.6", "0.8", "1.0"));
  EXPECT_THAT(labels_of(round_ticks(-1.05, 1.9, 7)),
              ElementsAre("-1.0", "-0.5", "0.0", "0.5", "1.0", "1.5"));
  EXPECT_THAT(labels_of(round_ticks(0.1, 0.3, 3)), ElementsAre("0.1", "0.2", "0.3"));
  EXPECT_THAT(labels_of(round_ticks(273.15, 1273.15, 7)),
              ElementsAre("400", "600", "800", "1000", "1200"));
  EXPECT_THAT(labels_of(round_ticks(0, 3e7, 4)), ElementsAre("0", "1e+07", "2e+07", "3e+07"));
  EXPECT_THAT(labels_of(round_ticks(1e-9, 2e-9, 3)), ElementsAre("1.0e-09", "1.5e-09", "2.0e-09"));
  EXPECT_THAT(labels_of(round_ticks(1e6, 1e6 + 2, 3)),
              ElementsAre("1.000000e+06", "1.000001e+06", "1.000002e+06"));
}

TEST(Ticks, AreSeveralAndNotTooManyWhateverTheRange) {
  for (int exponent = -300; exponent <= 300; exponent += 7)
    for (const double low : {0.0, 1.0, -3.7, 12.3})
      for (const double extent : {1.0, 1.7, 2.3, 4.9, 9.99}) {
        const double scale = std::pow(10, exponent);
        const auto ticks = round_ticks(low * scale, (low + extent) * scale, 7);
        ASSERT_GE(ticks.size(), 2u) << low << " " << extent << " e" << exponent;
        ASSERT_LE(ticks.size(), 7u);
        for (std::size_t i = 0; i < ticks.size(); ++i) {
          EXPECT_GE(ticks[i].value, low * scale);
          EXPECT_LE(ticks[i].value, (low + extent) * scale);
          EXPECT_NEAR(std::stod(ticks[i].label) / scale, ticks[i].value / scale, 1e-6);
          if (i > 0) {
            EXPECT_NE(ticks[i].label, ticks[i - 1].label);
          }
        }
      }
}

TEST(Ticks, RoundBelow) {
  const std::pair<double, double> cases[] = {
      {1, 1},   {1.99, 1},     {2, 2},           {4.9, 2},   {5, 5},        {9.9, 5},
      {10, 10}, {0.2577, 0.2}, {3e-200, 2e-200}, {0.1, 0.1}, {1e300, 1e300}};
  for (const auto& [value, expected] : cases) EXPECT_EQ(round_below(value), expected) << value;
}

Image white(std::size_t width, std::size_t height) {
  return {width, height, {"Y"}, std::vector<double>(width * height, 1.0)};
}

double ink(const Image& canvas) {
  double sum = 0;
  for (const double value : canvas.values()) sum += 1 - value;
  return sum;
}

TEST(TextDrawing, PutsInkWhereTheTextIs) {
  const Text text(20);
  Image canvas = white(100, 40);
  text.draw(canvas, 10, 30, "I");
  EXPECT_GT(ink(canvas), 20);
  for (std::size_t y = 0; y < 40; ++y)
    for (std::size_t x = 0; x < 100; ++x)
      if (canvas.at(x, y, 0) < 1) {
        EXPECT_GE(x, 10u);
        EXPECT_LT(static_cast<double>(x), 10 + text.width("I"));
        EXPECT_LT(y, 30u);  // above the baseline
        EXPECT_GE(y, 14u);  // capitals are 0.73 em high
      }
  Image empty = white(100, 40);
  text.draw(empty, 10, 30, "   ");
  EXPECT_EQ(ink(empty), 0);
}

TEST(TextDrawing, GoesOnFromLetterToLetter) {
  const Text text(18);
  EXPECT_EQ(text.width(""), 0);
  EXPECT_DOUBLE_EQ(text.width("flow"),
                   text.width("f") + text.width("l") + text.width("o") + text.width("w"));
  Image whole = white(200, 40), parts = white(200, 40);
  text.draw(whole, 3.25, 30, "m/s²");
  text.draw(parts, 3.25, 30, "m");
  text.draw(parts, 3.25 + text.width("m"), 30, "/s²");
  EXPECT_TRUE(std::equal(whole.values().begin(), whole.values().end(), parts.values().begin()));
}

TEST(TextDrawing, ReadsUtf8AndReplacesWhatIsNone) {
  const Text text(18);
  for (const char* letter : {"ä", "κ", "°", "\xf0\x9f\x98\x80"}) {
    Image canvas = white(40, 40);
    text.draw(canvas, 5, 30, letter);
    EXPECT_GT(ink(canvas), 5) << letter;
  }
  const double replaced = text.width("\uFFFD");
  // a lone continuation, a lead without its rest, an overlong form, a surrogate, beyond Unicode
  const std::pair<const char*, int> wrong[] = {
      {"\x80", 1}, {"\xc3", 1}, {"\xc0\xaf", 2}, {"\xed\xa0\x80", 3}, {"\xf4\x90\x80\x80", 4}};
  for (const auto& [bytes, count] : wrong) EXPECT_NEAR(text.width(bytes), count * replaced, 1e-9);
}

TEST(TextDrawing, LeavesOutWhatIsOutsideAndShortens) {
  const Text text(20);
  Image canvas = white(10, 10);
  text.draw(canvas, -30, 5, "WWWWWWWW");
  text.draw(canvas, 0, 500, "W");
  text.draw(canvas, 0, -500, "W");
  EXPECT_EQ(text.shortened("short", 1000), "short");
  const std::string cut = text.shortened("a rather long name of a field ä", 120);
  EXPECT_THAT(cut, testing::StartsWith("a rather"));
  EXPECT_THAT(cut, testing::EndsWith("…"));
  EXPECT_LE(text.width(cut), 120);
  EXPECT_GT(text.width(cut), 95);
}

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

}  // namespace
}  // namespace hiac::tools
