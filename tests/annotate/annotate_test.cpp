#include "hiac/annotate/annotate.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "hiac/image/srgb.hpp"
#include "tests/annotate/annotated_scene.hpp"

namespace hiac {
namespace {

using test::colored_scene;
using test::whole_annotation;
using testing::HasSubstr;
using testing::ThrowsMessage;

const AnnotationFacts kFacts{"temperature (K)", "1.5"};

Image filled(ImageSize size, double level, double alpha) {
  Image image(size.width, size.height, rgba_channels());
  for (std::size_t k = 0; k < image.values().size(); ++k)
    image.values()[k] = k % 4 == 3 ? alpha : level * alpha;
  return image;
}

constexpr ImageSize kSizes[] = {{1024, 768}, {640, 480},   {160, 120}, {300, 1200},
                                {2000, 300}, {4096, 4096}, {90, 90}};

TEST(Annotate, PartsStayInsideAndApartInPicturesOfAnySize) {
  for (const ImageSize size : kSizes) {
    const Annotator annotator(whole_annotation(), colored_scene(size), kFacts);
    ASSERT_EQ(annotator.boxes().size(), 5U);
    const double margin = std::round(0.02 * std::min(size.width, size.height));
    for (std::size_t k = 0; k < 5; ++k) {
      const PixelBox& box = annotator.boxes()[k];
      EXPECT_GE(static_cast<double>(box.x), margin);
      EXPECT_GE(static_cast<double>(box.y), margin);
      EXPECT_LE(static_cast<double>(box.x + box.width), size.width - margin);
      EXPECT_LE(static_cast<double>(box.y + box.height), size.height - margin);
      for (std::size_t j = 0; j < k; ++j)
        EXPECT_FALSE(box.meets(annotator.boxes()[j]))
            << annotator.parts()[j].name << " " << annotator.parts()[k].name << " " << size.width;
    }
  }
}

TEST(Annotate, DrawsInItsBoxesAloneAndInEveryOne) {
  for (const ImageSize size : kSizes) {
    if (size.width > 2048) continue;
    const Annotator annotator(whole_annotation(), colored_scene(size), kFacts);
    const Image before = filled(size, 0.3, 1);
    Image picture = before;
    annotator.draw(picture, {0, 0, size.width, size.height}, true);
    std::vector<int> changed(5);
    for (std::uint32_t y = 0; y < size.height; ++y)
      for (std::uint32_t x = 0; x < size.width; ++x) {
        if (std::ranges::equal(picture.pixel(x, y), before.pixel(x, y))) continue;
        const PixelBox pixel{x, y, 1, 1};
        bool inside = false;
        for (std::size_t k = 0; k < 5; ++k)
          if (annotator.boxes()[k].meets(pixel)) {
            inside = true;
            ++changed[k];
          }
        ASSERT_TRUE(inside) << x << " " << y;
      }
    for (const int count : changed) EXPECT_GT(count, 10);
  }
}

TEST(Annotate, EveryPlaceIsWhereItsNameSays) {
  const ImageSize size{800, 600};
  const int row[] = {0, 0, 0, 1, 1, 2, 2, 2}, column[] = {0, 1, 2, 0, 2, 0, 1, 2};
  for (int k = 0; k < 8; ++k) {
    Annotation annotation;
    annotation.margin = {10, true};
    annotation.axes.emplace().place = static_cast<AnnotationPlace>(k);
    annotation.axes->size = {100, true};
    const PixelBox box = Annotator(annotation, colored_scene(size), kFacts).boxes()[0];
    const std::int64_t xs[] = {10, 350, 690}, ys[] = {10, 250, 490};
    EXPECT_EQ(box, (PixelBox{xs[column[k]], ys[row[k]], 100, 100})) << k;
  }
}

TEST(Annotate, SizesAreSharesOrPixels) {
  Annotation annotation;
  annotation.axes.emplace().size = {0.25, false};
  EXPECT_EQ(Annotator(annotation, colored_scene({800, 600}), kFacts).parts()[0].width, 150);
  EXPECT_EQ(Annotator(annotation, colored_scene({400, 600}), kFacts).parts()[0].width, 100);
  annotation.axes->size = {77, true};
  EXPECT_EQ(Annotator(annotation, colored_scene({800, 600}), kFacts).parts()[0].width, 77);
}

TEST(Annotate, PartsInOnePlaceStandAboveOneAnother) {
  Annotation annotation = whole_annotation();
  for (auto* place : {&annotation.title->place, &annotation.time->place, &annotation.axes->place})
    *place = AnnotationPlace::bottom_left;
  const Annotator annotator(annotation, colored_scene({800, 600}), kFacts);
  const auto& boxes = annotator.boxes();
  const int gap = 9;  // half of 18 pixels
  EXPECT_EQ(boxes[1].y, boxes[0].y + boxes[0].height + gap);
  EXPECT_EQ(boxes[2].y, boxes[1].y + boxes[1].height + gap);
  EXPECT_EQ(boxes[2].y + boxes[2].height, 600 - 12);
}

TEST(Annotate, APartOfAPictureIsThatPartOfTheWhole) {
  const ImageSize size{320, 240};
  const Annotator annotator(whole_annotation(), colored_scene(size), kFacts);
  Image whole = filled(size, 0.3, 1);
  annotator.draw(whole, {0, 0, 320, 240}, true);
  const PixelRect rect{203, 55, 101, 160};
  Image part = filled({rect.width, rect.height}, 0.3, 1);
  annotator.draw(part, rect, true);
  for (std::uint32_t y = 0; y < rect.height; ++y)
    for (std::uint32_t x = 0; x < rect.width; ++x)
      ASSERT_TRUE(std::ranges::equal(part.pixel(x, y), whole.pixel(rect.x + x, rect.y + y)));
}

TEST(Annotate, LettersContrastWithAnyBackground) {
  for (int grey = 0; grey <= 255; ++grey) {
    const double level = srgb_decode(grey / 255.0);
    const Ink ink = ink_on(level, std::nullopt);
    EXPECT_GE(contrast(level, luminance(ink.text)), 4.5) << grey;  // black and white decode alike
    EXPECT_EQ(ink.is_light, ink.text[0] > 0.5);
    EXPECT_NE(ink.halo, ink.text);
  }
  const Ink red = ink_on(0, Color{0.5, 0, 0});
  EXPECT_NEAR(red.text[0], srgb_encode(0.5), 1e-15);
  EXPECT_EQ(red.halo, (Color{1, 1, 1}));
}

TEST(Annotate, TextFollowsTheBackgroundBelowIt) {
  Scene scene = colored_scene({400, 300});
  const auto is_light = [&](std::size_t k) {
    return Annotator(whole_annotation(), scene, kFacts).ink(k).is_light;
  };
  EXPECT_TRUE(is_light(0));
  scene.background.color = {1, 1, 1};
  EXPECT_FALSE(is_light(0));
  scene.background.pattern = BackgroundPattern::gradient;  // white above, black below
  EXPECT_FALSE(is_light(0));                               // the title
  EXPECT_TRUE(is_light(2));                                // the axes
  Annotation red = whole_annotation();
  red.color = {1, 0, 0};
  EXPECT_NEAR(Annotator(red, scene, kFacts).ink(0).text[0], 1, 1e-12);
}

TEST(Annotate, WritesTheTimeOfTheMeshOrTheOneGiven) {
  Annotation annotation;
  annotation.time.emplace();
  const auto width = [&](const std::string& time) {
    return Annotator(annotation, colored_scene({800, 600}), {"", time}).parts()[0].width;
  };
  EXPECT_THAT([&] { width(""); },
              ThrowsMessage<InputError>(HasSubstr("key `annotation.time`: the mesh has no time")));
  const int narrow = width("1");
  EXPECT_GT(width("1.5"), narrow);
  annotation.time->unit = "s";
  EXPECT_GT(width("1"), narrow);
  annotation.time->unit = "";
  annotation.time->value = 1;
  EXPECT_EQ(width("17.25"), narrow);
}

TEST(Annotate, KnowsTheMeshsLabelAndTime) {
  ZooMesh mesh;
  mesh.fields.push_back({"t", "K", FieldLocation::node, 1, {}});
  mesh.metadata = {{"source", "x"}, {"time", "0.30000000000000004"}};
  const AnnotationFacts facts = annotation_facts(mesh, colored_scene({4, 4}).volume);
  EXPECT_EQ(facts.color_label, "t (K)");
  EXPECT_EQ(facts.time, "0.3");
  mesh.metadata[1].second = "noon";
  EXPECT_EQ(annotation_facts(mesh, Volume{}).time, "noon");
}

TEST(Annotate, RefusesWhatDoesNotFitAndDoubtsTheRest) {
  Annotation annotation;
  annotation.axes.emplace().size = {301, true};
  const Scene scene = colored_scene({400, 300});
  EXPECT_THAT([&] { Annotator(annotation, scene, kFacts); },
              ThrowsMessage<InputError>(HasSubstr("key `annotation.axes`: does not fit")));
  annotation.axes->size = {0.5, false};
  annotation.text_size = {301, true};
  EXPECT_THAT([&] { Annotator(annotation, scene, kFacts); },
              ThrowsMessage<InputError>(HasSubstr("key `annotation.text_size`: letters of 301")));
  annotation.text_size = {5, true};
  annotation.title.emplace().text = std::string(2000, 'W');  // is shortened
  annotation.title->place = AnnotationPlace::left;
  const std::vector<std::string> doubts = Annotator(annotation, scene, kFacts).doubts();
  ASSERT_EQ(doubts.size(), 2U);
  EXPECT_THAT(doubts[0], HasSubstr("annotation.title and annotation.axes overlap"));
  EXPECT_THAT(doubts[1], HasSubstr("5 pixels are hard to read"));
  EXPECT_TRUE(Annotator(whole_annotation(), scene, kFacts).doubts().empty());
}

}  // namespace
}  // namespace hiac
