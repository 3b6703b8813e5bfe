#include "hiac/scene/annotation_keys.hpp"

#include <random>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/specification.hpp"
#include "hiac/scene/starter_text.hpp"
#include "tests/scene/scene_text.hpp"

namespace hiac {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string kColored =
    kLeast + "[volume.color]\nfield = \"t\"\npoints = [[1, 0, 0, 0], [9, 1, 1, 1]]\n";

Annotation annotation_of(const std::string& text) {
  return parse_scene(kColored + text, "view").annotation;
}

TEST(AnnotationKeys, NothingIsDrawnUnlessATableAsksForIt) {
  EXPECT_EQ(parse_scene(kLeast, "view").annotation, Annotation{});
  EXPECT_FALSE(annotation_of("[annotation]\ntext_size = 0.1\n").draws());
  EXPECT_TRUE(annotation_of("[annotation.axes]\n").draws());
  EXPECT_TRUE(annotation_of("[annotation.axes]\nshow = true\n").draws());
  EXPECT_EQ(annotation_of("[annotation.axes]\nshow = false\nsize = 0.5\n"), Annotation{});
}

TEST(AnnotationKeys, AreRead) {
  const Annotation a = annotation_of(
      "[annotation]\ntext_size = \"24px\"\nmargin = 0\ncolor = [1, 0.5, 0]\nformats = \"all\"\n"
      "[annotation.title]\ntext = \"A b\"\nplace = \"bottom-left\"\nsize = 0.1\n"
      "[annotation.time]\nvalue = -2\nunit = \"ms\"\n"
      "[annotation.scale]\nlength = 3.5\nunit = \"m\"\n"
      "[annotation.colorbar]\nplace = \"top\"\nlabel = \"T\"\nscale = \"log\"\n");
  EXPECT_EQ(a.text_size, (PictureLength{24, true}));
  EXPECT_EQ(a.margin, (PictureLength{0, false}));
  EXPECT_EQ(a.color, (Color{1, 0.5, 0}));
  EXPECT_TRUE(a.in_float_formats);
  EXPECT_EQ(a.title->text, "A b");
  EXPECT_EQ(a.title->place, AnnotationPlace::bottom_left);
  EXPECT_EQ(a.title->size, (PictureLength{0.1, false}));
  EXPECT_EQ(a.time->value, -2);
  EXPECT_EQ(a.time->unit, "ms");
  EXPECT_EQ(a.scale->length, 3.5);
  EXPECT_EQ(a.scale->unit, "m");
  EXPECT_EQ(a.color_bar->place, AnnotationPlace::top);
  EXPECT_EQ(a.color_bar->label, "T");
  EXPECT_EQ(a.color_bar->logarithmic, true);
  EXPECT_FALSE(a.axes);
  EXPECT_EQ(PictureLength({0.5, false}).pixels({400, 300}), 150);
}

TEST(AnnotationKeys, ABarHasTheScaleOfTheColour) {
  const std::string bar = "[annotation.colorbar]\n";
  EXPECT_EQ(annotation_of(bar).color_bar->logarithmic, false);
  EXPECT_EQ(annotation_of("scale = \"log\"\n" + bar).color_bar->logarithmic, true);
  EXPECT_EQ(
      annotation_of("scale = \"log\"\n" + bar + "scale = \"linear\"\n").color_bar->logarithmic,
      false);
  EXPECT_TRUE(parse_scene(kColored + "scale = \"log\"\n", "view").annotation.bar_is_logarithmic);
  EXPECT_FALSE(parse_scene(kColored, "view").annotation.bar_is_logarithmic);
}

TEST(AnnotationKeys, ABarAloneHasTheScaleOfTheBarThatMayBeHidden) {
  const std::string bar = "[annotation.colorbar]\nscale = ", hidden = "show = false\n";
  const Annotation log = annotation_of(bar + "\"log\"\n" + hidden);
  EXPECT_TRUE(log.bar_is_logarithmic);
  EXPECT_FALSE(log.draws());
  EXPECT_TRUE(annotation_of(bar + "\"log\"\n").bar_is_logarithmic);
  const std::string linear = "scale = \"log\"\n" + bar + "\"linear\"\n";
  EXPECT_FALSE(annotation_of(linear).bar_is_logarithmic);
  EXPECT_FALSE(annotation_of(linear + hidden).bar_is_logarithmic);
}

TEST(AnnotationKeys, BadValuesAreRefusedInOneLine) {
  const std::pair<const char*, const char*> bad[] = {
      {"[annotation]\ntext_size = 2\n", "annotation.text_size`: out of range"},
      {"[annotation]\ntext_size = 0\n", "expected a positive size, found 0"},
      {"[annotation]\ntext_size = \"24\"\n", "no such size"},
      {"[annotation]\ntext_size = \"24 px\"\n", "no such size"},
      {"[annotation]\ntext_size = \"-3px\"\n", "no such size"},
      {"[annotation]\ntext_size = \"nanpx\"\n", "no such size"},
      {"[annotation]\ntext_size = \"1e9px\"\n", "no such size"},
      {"[annotation]\nmargin = \"px\"\n", "annotation.margin`: no such size"},
      {"[annotation]\ncolor = \"red\"\n", "no such colour"},
      {"[annotation]\ncolor = [1, -1, 0]\n", "a colour is not negative"},
      {"[annotation]\nformats = \"png\"\n", "expected one of integer, all, found png"},
      {"[annotation]\nlegend = 1\n", "unknown key"},
      {"[annotation.title]\n", "annotation.title.text`: is missing"},
      {"[annotation.title]\ntext = \"\"\n", "empty"},
      {"[annotation.axes]\nshow = 1\n", "expected true or false, found a whole number"},
      {"[annotation.axes]\nplace = \"middle\"\n", "no such choice"},
      {"[annotation.colorbar]\nplace = \"top-left\"\n", "expected one of left, right, top, bottom"},
      {"[annotation.scale]\nlength = 0\n", "expected a positive number"},
      {"[annotation.time]\nvalue = \"now\"\n", "wrong type"},
      {"annotation = 3\n", "wrong type (expected a table"},
  };
  for (const auto& [text, message] : bad) {
    const bool is_root = std::string_view(text).starts_with("annotation");
    EXPECT_THAT([&] { parse_scene(is_root ? text + kColored : kColored + text, "view"); },
                ThrowsMessage<InputError>(HasSubstr(message)))
        << text;
  }
  EXPECT_THAT([] { parse_scene(kLeast + "[annotation.colorbar]\n", "view"); },
              ThrowsMessage<InputError>(HasSubstr(
                  "key `annotation.colorbar`: shows the colours of [volume.color], which is")));
  const std::string override = "annotation.axes.size=big";
  EXPECT_THAT(
      [&] {
        parse_scene(kLeast, "view", "", {&override, 1});
      },
      ThrowsMessage<UsageError>(HasSubstr("annotation.axes.size=big: key")));
}

TEST(AnnotationKeys, TheTextOfASceneGivesThemBack) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.01, 1);
  const auto coin = [&] { return random() % 2 == 0; };
  const auto size = [&] {
    return coin() ? PictureLength{unit(random), false} : PictureLength{600 * unit(random), true};
  };
  const auto place = [&] { return static_cast<AnnotationPlace>(random() % 8); };
  Scene scene = parse_scene(kColored, "view").scene;
  for (int trial = 0; trial < 200; ++trial) {
    Annotation a;
    a.text_size = size();
    a.margin = size();
    if (coin()) a.color = {unit(random), 0, unit(random)};
    a.in_float_formats = coin();
    if (coin()) a.title = {"a \"b\" é", place(), size()};
    if (coin()) a.time = {place(), size(), std::nullopt, coin() ? "s" : ""};
    if (a.time && coin()) a.time->value = unit(random) - 0.5;
    if (coin()) a.axes = {place(), size()};
    if (coin()) a.scale = {place(), size(), std::nullopt, coin() ? "mm" : ""};
    if (a.scale && coin()) a.scale->length = unit(random);
    if (coin()) a.color_bar = {AnnotationPlace::left, size(), std::nullopt, coin()};
    if (a.color_bar && coin()) a.color_bar->label = "T (K)";
    a.bar_is_logarithmic = a.color_bar ? *a.color_bar->logarithmic : coin();
    for (const Comments comments : {Comments::none, Comments::explain}) {
      const std::string text = to_toml(scene, a, comments);
      const ParsedScene read = parse_scene(text, "text");
      EXPECT_EQ(read.annotation, a) << text;
      EXPECT_EQ(read.scene, scene);
    }
  }
  EXPECT_EQ(to_toml(scene, Annotation{}), to_toml(scene));
}

TEST(AnnotationKeys, StarterViewsHaveThemAsComments) {
  const Scene scene = parse_scene(kColored, "view").scene;
  std::string text = starter_text(scene, "viridis", {1, 2});
  EXPECT_FALSE(parse_scene(text, "text").annotation.draws());
  // what is switched on by taking the signs away
  const std::size_t begin = text.find("# [annotation]");
  ASSERT_NE(begin, std::string::npos);
  std::string on = text.substr(0, begin);
  for (std::size_t at = begin; at < text.size();) {
    const std::size_t end = text.find('\n', at) + 1;
    const std::string line = text.substr(at, end - at);
    const bool has_value = line.find("=  #") == std::string::npos;
    on += line.starts_with("# ") && has_value ? line.substr(2) : line;
    at = end;
  }
  const Annotation a = parse_scene(on, "text").annotation;
  EXPECT_TRUE(a.title && a.time && a.axes && a.scale && a.color_bar);
}

}  // namespace
}  // namespace hiac
