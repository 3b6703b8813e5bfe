#include "hiac/annotate/part_layout.hpp"

#include <gmock/gmock.h>

#include "hiac/annotate/caption.hpp"
#include "hiac/annotate/scalar_axis.hpp"
#include "hiac/base/error.hpp"
#include "tests/annotate/annotated_scene.hpp"

namespace hiac {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;
using enum AnnotationPlace;

AnnotationPart part_at(AnnotationPlace place, int width, int height) {
  return {"axes", place, width, height, [](Canvas&, const Ink&) {}};
}

TEST(PartLayout, StacksPartsOfOnePlaceInTheirOrder) {
  const AnnotationPart parts[] = {part_at(bottom_right, 30, 10), part_at(top, 21, 11),
                                  part_at(bottom_right, 20, 20), part_at(left, 10, 31),
                                  part_at(bottom_right, 25, 5),  part_at(left, 12, 20)};
  // three and two of them with gaps of 3 between: 41 and 54 high
  EXPECT_THAT(
      part_boxes(parts, {200, 101}, 4, 3),
      ElementsAre(PixelBox{166, 56, 30, 10}, PixelBox{89, 4, 21, 11}, PixelBox{176, 69, 20, 20},
                  PixelBox{4, 23, 10, 31}, PixelBox{171, 92, 25, 5}, PixelBox{4, 57, 12, 20}));
}

TEST(PartLayout, TakesWhatFitsToThePixelAndRefusesOneMore) {
  for (const AnnotationPlace place : {top_left, bottom_right, right, top}) {
    const bool has_margin_across = place != top, has_margin_down = place != right;
    const int most_wide = has_margin_across ? 95 : 100, most_high = has_margin_down ? 45 : 50;
    const auto boxes = [&](int width, int height) {
      const AnnotationPart parts[] = {part_at(place, width, height)};
      return part_boxes(parts, {100, 50}, 5, 3);
    };
    EXPECT_NO_THROW(boxes(most_wide, most_high));
    EXPECT_THROW(boxes(most_wide + (has_margin_across ? 1 : 2), 1), InputError);
    EXPECT_THROW(boxes(1, most_high + (has_margin_down ? 1 : 2)), InputError);
  }
  const AnnotationPart wide[] = {part_at(top_right, 99, 9)};
  EXPECT_THAT(
      [&] {
        part_boxes(wide, {100, 50}, 5, 3);
      },
      ThrowsMessage<InputError>(
          "key `annotation.axes`: does not fit the picture (99 x 9 pixels at -4,5 of 100 x "
          "50)"));
}

TEST(PixelBox, MeetsWhatSharesAPixelWithIt) {
  const PixelBox box{10, 20, 5, 7};
  for (std::int64_t y = 0; y < 40; ++y)
    for (std::int64_t x = 0; x < 30; ++x) {
      const PixelBox other{x, y, 3, 2};
      bool shares = false;
      for (std::int64_t j = y; j < y + 2; ++j)
        for (std::int64_t i = x; i < x + 3; ++i)
          shares = shares || (i >= 10 && i < 15 && j >= 20 && j < 27);
      EXPECT_EQ(box.meets(other), shares) << x << " " << y;
      EXPECT_EQ(other.meets(box), shares) << x << " " << y;
    }
}

TEST(Caption, IsAsWideAsItsTextAndNoWiderThanItMayBe) {
  const Lettering letters{20};  // a halo of 2, 24 high
  const Text text(20);
  const AnnotationPart part = caption("title", top, "Some words", letters, 1000);
  EXPECT_EQ(part.name, "title");
  EXPECT_EQ(part.place, top);
  EXPECT_EQ(part.width, static_cast<int>(std::ceil(text.width("Some words"))) + 4);
  EXPECT_EQ(part.height, 28);
  EXPECT_EQ(caption("title", top, "Some words", letters, part.width).width, part.width);
  const AnnotationPart cut = caption("title", top, "Some words", letters, part.width - 1);
  EXPECT_LT(cut.width, part.width);
  EXPECT_GT(cut.width, part.width - 40);
  EXPECT_EQ(caption("title", top, "Some words", letters, 1).width,
            static_cast<int>(std::ceil(text.width("\u2026"))) + 4);
}

TEST(Caption, StandsOnItsBaselineBehindTheHalo) {
  const Canvas canvas = test::drawn(caption("title", top, "HH", Lettering{20}, 1000));
  int first = 1000, last = 0, top_row = 1000, bottom = 0;
  for (int y = 0; y < canvas.height(); ++y)
    for (int x = 0; x < canvas.width(); ++x)
      if (test::alpha(canvas, x, y) > 0) {
        first = std::min(first, x);
        last = std::max(last, x);
        top_row = std::min(top_row, y);
        bottom = std::max(bottom, y);
      }
  EXPECT_EQ(bottom, 2 + 19 - 1);  // 0.93 em below the halo
  EXPECT_NEAR(top_row, 21 - 0.73 * 20, 1);
  EXPECT_NEAR(first, 2 + 2, 1);
  EXPECT_NEAR(canvas.width() - 1 - last, 2 + 2, 1.5);
}

TEST(Lettering, HasSizesThatFollowFromTheLetters) {
  struct Case {
    int em, halo, line, height, ascent;
  };
  for (const Case& c : {Case{1, 1, 1, 1, 1},
                        {14, 1, 1, 17, 13},
                        {15, 2, 1, 18, 14},
                        {18, 2, 1, 22, 17},
                        {24, 2, 2, 29, 22},
                        {100, 10, 6, 120, 93}}) {
    const Lettering letters{c.em};
    EXPECT_EQ(letters.halo(), c.halo) << c.em;
    EXPECT_EQ(letters.line(), c.line) << c.em;
    EXPECT_EQ(letters.height(), c.height) << c.em;
    EXPECT_EQ(letters.ascent(), c.ascent) << c.em;
  }
  EXPECT_EQ(Lettering{10}.at_least(5, 0.4), 5);
  EXPECT_EQ(Lettering{10}.at_least(5, 0.6), 6);
}

std::array<double, 2> ends_of(const ScalarAxis& axis) {
  return {axis.value_at(0), axis.value_at(1)};
}

TEST(ScalarAxis, IsWidenedWhereItIsTooNarrow) {
  using Ends = std::array<double, 2>;
  EXPECT_EQ(ends_of({1, 3, false}), (Ends{1, 3}));
  EXPECT_EQ(ends_of({4, 4, false}), (Ends{2, 6}));  // by half of the value
  EXPECT_EQ(ends_of({-4, -4, false}), (Ends{-6, -2}));
  EXPECT_EQ(ends_of({0, 0, false}), (Ends{-1, 1}));
  EXPECT_EQ(ends_of({0, 1e-295, false}), (Ends{-1, 1}));
  EXPECT_EQ(ends_of({1e-291, 1e-291, false}), (Ends{-1, 1}));
  const Ends small = ends_of({1e-289, 1e-289, false});
  EXPECT_NEAR(small[0] / 1e-289, 0.5, 1e-9);
  EXPECT_NEAR(small[1] / 1e-289, 1.5, 1e-9);
  // half of the range against a billionth of a thousandth of the values
  EXPECT_EQ(ends_of({1, 1 + 2.1e-12, false}), (Ends{1, 1 + 2.1e-12}));
  EXPECT_NEAR(ends_of({1, 1 + 1.9e-12, false})[0], 0.5, 1e-9);
  // a logarithm stays above zero
  const Ends tiny = ends_of({1e-300, 1e-300, true});
  EXPECT_NEAR(tiny[0] / 1e-300, 0.5, 1e-9);
  EXPECT_NEAR(tiny[1] / 1e-300, 1.5, 1e-9);
}

TEST(ScalarAxis, GoesThereAndBack) {
  const ScalarAxis linear(-2, 6, false), decades(0.01, 100, true), widest(-1.7e308, 1.7e308, false);
  EXPECT_EQ(linear.value_at(0.25), 0);
  EXPECT_EQ(linear.position_of(0), 0.25);
  EXPECT_NEAR(decades.value_at(0.25), 0.1, 1e-15);
  EXPECT_NEAR(decades.position_of(10), 0.75, 1e-15);
  // no value is beside the map, however its logarithm is rounded
  for (const double low : {0.01, 0.3, 0.7, 1.1, 3.0}) {
    const ScalarAxis axis(low, 7 * low, true);
    for (const double t : {0.0, 1e-17, 1.0}) {
      EXPECT_GE(axis.value_at(t), low);
      EXPECT_LE(axis.value_at(t), 7 * low);
    }
  }
  EXPECT_EQ(widest.value_at(0.5), 0);
  EXPECT_EQ(widest.position_of(0), 0.5);
}

TEST(ScalarAxis, HasAsManyTicksAsFitBetweenTwoAndSeven) {
  const auto count = [](const ScalarAxis& axis, std::size_t most) {
    return axis.ticks([&](const std::vector<Tick>& ticks) { return ticks.size() <= most; }).size();
  };
  const ScalarAxis ten(0, 10, false), six(0, 6, false), decades(1, 1e6, true);
  EXPECT_EQ(count(ten, 100), 6U);  // 0, 2 ... 10
  EXPECT_EQ(count(ten, 5), 3U);    // 0, 5, 10
  EXPECT_EQ(count(ten, 2), 2U);    // 0, 10
  EXPECT_EQ(count(ten, 0), 2U);    // two even where they do not fit
  EXPECT_EQ(count(six, 100), 7U);
  EXPECT_EQ(count(decades, 100), 7U);
  EXPECT_EQ(count(decades, 4), 4U);  // every other one
}

TEST(ScalarAxis, RefusesALogarithmOfWhatIsNotPositive) {
  EXPECT_NO_THROW(axis_over({-1, 1}, false, "k"));
  EXPECT_NO_THROW(axis_over({1e-300, 1}, true, "k"));
  for (const double low : {0.0, -1.0})
    EXPECT_THAT(
        [&] {
          axis_over({low, 1}, true, "k");
        },
        ThrowsMessage<InputError>(
            HasSubstr("key `k`: a logarithmic bar needs positive scalars (found ")));
}

}  // namespace
}  // namespace hiac
