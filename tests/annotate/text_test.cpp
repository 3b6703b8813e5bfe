#include "hiac/annotate/text.hpp"

#include <gmock/gmock.h>

#include "hiac/image/image.hpp"

namespace hiac {
namespace {

Image white(std::size_t width, std::size_t height) {
  return {width, height, {"Y"}, std::vector<double>(width * height, 1.0)};
}

/// Black letters on white paper.
void draw(const Text& text, Image& canvas, double x, int baseline, std::string_view line) {
  text.draw(x, baseline, line, [&](std::int64_t i, std::int64_t j, double coverage) {
    EXPECT_GT(coverage, 0);
    EXPECT_LE(coverage, 1);
    const bool inside = i >= 0 && j >= 0 && i < static_cast<std::int64_t>(canvas.width()) &&
                        j < static_cast<std::int64_t>(canvas.height());
    if (inside)
      canvas.at(static_cast<std::size_t>(i), static_cast<std::size_t>(j), 0) *= 1 - coverage;
  });
}

double ink(const Image& canvas) {
  double sum = 0;
  for (const double value : canvas.values()) sum += 1 - value;
  return sum;
}

TEST(TextDrawing, PutsInkWhereTheTextIs) {
  const Text text(20);
  Image canvas = white(100, 40);
  draw(text, canvas, 10, 30, "I");
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
  draw(text, empty, 10, 30, "   ");
  EXPECT_EQ(ink(empty), 0);
}

TEST(TextDrawing, GoesOnFromLetterToLetter) {
  const Text text(18);
  EXPECT_EQ(text.width(""), 0);
  EXPECT_DOUBLE_EQ(text.width("flow"),
                   text.width("f") + text.width("l") + text.width("o") + text.width("w"));
  Image whole = white(200, 40), parts = white(200, 40);
  draw(text, whole, 3.25, 30, "m/s²");
  draw(text, parts, 3.25, 30, "m");
  draw(text, parts, 3.25 + text.width("m"), 30, "/s²");
  EXPECT_TRUE(std::equal(whole.values().begin(), whole.values().end(), parts.values().begin()));
}

TEST(TextDrawing, ReadsUtf8AndReplacesWhatIsNone) {
  const Text text(18);
  for (const char* letter : {"ä", "κ", "°", "\xf0\x9f\x98\x80"}) {
    Image canvas = white(40, 40);
    draw(text, canvas, 5, 30, letter);
    EXPECT_GT(ink(canvas), 5) << letter;
  }
  const double replaced = text.width("\uFFFD");
  // a lone continuation, a lead without its rest, an overlong form, a surrogate, beyond Unicode
  const std::pair<const char*, int> wrong[] = {
      {"\x80", 1}, {"\xc3", 1}, {"\xc0\xaf", 2}, {"\xed\xa0\x80", 3}, {"\xf4\x90\x80\x80", 4}};
  for (const auto& [bytes, count] : wrong) EXPECT_NEAR(text.width(bytes), count * replaced, 1e-9);
}

TEST(TextDrawing, ShortensWhatIsTooLong) {
  const Text text(20);
  EXPECT_EQ(text.shortened("short", 1000), "short");
  const std::string cut = text.shortened("a rather long name of a field ä", 120);
  EXPECT_THAT(cut, testing::StartsWith("a rather"));
  EXPECT_THAT(cut, testing::EndsWith("…"));
  EXPECT_LE(text.width(cut), 120);
  EXPECT_GT(text.width(cut), 95);
}

}  // namespace
}  // namespace hiac
