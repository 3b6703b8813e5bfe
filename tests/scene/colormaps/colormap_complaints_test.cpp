// Files of colour maps: what is said of malformed ones, and what is taken of unusual ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/colormaps/colormap_preset.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac {
namespace {

class ColormapFiles : public testing::Test {
 protected:
  ColormapPreset map_in(const std::string& text, const std::optional<std::string>& name = {}) {
    return read_colormap_preset(folder_.write("a.json", text), name);
  }
  /// The message behind the file's name; empty for none.
  std::string told_of_map(const std::string& text, const std::optional<std::string>& name = {}) {
    try {
      map_in(text, name);
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with(folder_.file("a.json") + ": ")) << message;
      return message.substr(folder_.file("a.json").size() + 2);
    }
    return "";
  }

  test::ScratchFolder folder_;
};

const std::string kOnePoint = R"("RGBPoints": [0, 0, 0.5, 1])";

TEST_F(ColormapFiles, BracketsNest64Deep) {
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
  };
  EXPECT_EQ(told_of_map(nested(64)), "holds no colour map");
  EXPECT_EQ(told_of_map(nested(65)), "malformed JSON (brackets nested too deep)");
  // brackets one behind the other, or within texts, do not add up
  std::string flat = "[";
  for (int i = 0; i < 70; ++i) flat += "{}, [], ";
  EXPECT_EQ(told_of_map(flat + "{\"Name\": \"" + std::string(70, '{') + "\\\"[\"}]"),
            "colour map ``: holds no points");
}

TEST_F(ColormapFiles, ThatAreMalformedAreRefused) {
  const std::pair<const char*, const char*> cases[] = {
      {"[{]", "malformed JSON ("},
      {"nothing", "malformed JSON ("},
      {"[1] 2", "malformed JSON ("},
      {"[,,]", "malformed JSON ("},
      {"<ColorMaps>", "malformed XML (Start-end tags mismatch)"},
      {"\xef\xbb\xbf <", "malformed XML ("},
      {R"([{"Name": "k", "IndexedColors": [1, 0, 0]}])",
       "colour map `k`: holds indexed colours, for categories (expected colours of scalars)"},
      {R"([{"Name": "k", "RGBPoints": []}])", "colour map `k`: holds no points"},
      {R"([{"Name": "k", "RGBPoints": [1, 2, 3, 4, 5]}])",
       "colour map `k`: expected scalar, red, green and blue for every point, found 5 numbers"},
      {R"([{"Name": "k", "RGBPoints": [0, 0, 1.5, 0]}])",
       "colour map `k`: a colour is out of range (expected 0 to 1, found 1.5)"},
      {R"([{"Name": "k", "RGBPoints": [0, 0, 0, -0.5]}])",
       "colour map `k`: a colour is out of range (expected 0 to 1, found -0.5)"},
      {R"([{"Name": "k", "RGBPoints": 3}])", "`RGBPoints` is not a list"},
      {R"([{"Name": "k", "RGBPoints": [true]}])", "`RGBPoints` holds something but numbers"},
      {R"({"Name": "k", "ColorSpace": "XYZ", "RGBPoints": [0, 0, 0, 0]})",
       "colour map `k`: colour space not known (expected RGB, HSV, Wrapped, Lab, CIELAB, "
       "Diverging or Step, found `XYZ`)"},
      {"<ColorMap name='k'><Point x='inf' r='0' g='0' b='0'/></ColorMap>",
       "colour map `k`: a scalar is not finite"},
      {"<ColorMap name='k'><Point x='1 ' r='0' g='0' b='0'/></ColorMap>",
       "a <Point> needs a number `x` (found \"1 \")"},
      {"<ColorMap name='k'><Point x='-1e308' r='0' g='0' b='0'/>"
       "<Point x='1e308' r='0' g='0' b='0'/></ColorMap>",
       "colour map `k`: the scalars' range is not finite"},
  };
  for (const auto& [text, message] : cases)
    EXPECT_THAT(told_of_map(text), testing::StartsWith(message)) << text;
}

TEST_F(ColormapFiles, CommasBeforeClosingBracketsAreBlanksOutsideTexts) {
  EXPECT_EQ(map_in("[{\"Name\": \"a,]\\\",}\", \"RGBPoints\": [0, 1, 0.5, 0 ,\t\r\n ], },]").name,
            "a,]\",}");
  EXPECT_EQ(told_of_map("[{" + kOnePoint + ",,}]").substr(0, 14), "malformed JSON");
}

TEST_F(ColormapFiles, NamesOfSpacesHaveAnyCase) {
  const auto space = [&](const std::string& name, const std::string& wrap) {
    return map_in("{\"ColorSpace\": \"" + name + "\", " + wrap + kOnePoint + "}").space;
  };
  EXPECT_EQ(space("WRAPPED HSV", ""), ColorSpace::hsv_wrapped);
  EXPECT_EQ(space("wrappedHSV", ""), ColorSpace::hsv_wrapped);
  EXPECT_EQ(space("hsv", "\"HSVWrap\": false, "), ColorSpace::hsv);
  EXPECT_EQ(space("hsv", "\"HSVWrap\": true, "), ColorSpace::hsv_wrapped);
  EXPECT_EQ(space("hsv", "\"HSVWrap\": 0, "), ColorSpace::hsv);
  EXPECT_EQ(space("hsv", "\"HSVWrap\": 2, "), ColorSpace::hsv_wrapped);
  EXPECT_EQ(space("hsv", "\"HSVWrap\": \"1\", "), ColorSpace::hsv);
  EXPECT_EQ(space("lab", "\"HSVWrap\": true, "), ColorSpace::lab);
  EXPECT_EQ(space("", ""), ColorSpace::rgb);
}

TEST_F(ColormapFiles, PointsComeBeforeIndexedColours) {
  EXPECT_EQ(map_in("[1, \"a\", {\"IndexedColors\": [1, 0, 0], " + kOnePoint + "}]").nodes.size(),
            1U);
}

TEST_F(ColormapFiles, PointsOfOneScalarKeepTheirOrder) {
  const ColormapPreset map =
      map_in(R"({"RGBPoints": [2, 1, 1, 1, 1, 0.25, 0, 0, 1, 0.75, 0, 0, 0, 0, 0, 0]})");
  ASSERT_EQ(map.nodes.size(), 4U);
  EXPECT_EQ(map.nodes[0].scalar, 0);
  EXPECT_EQ(map.nodes[1].rgb[0], 0.25);
  EXPECT_EQ(map.nodes[2].rgb[0], 0.75);
  EXPECT_EQ(map.nodes[3].scalar, 2);
}

TEST_F(ColormapFiles, NamesAreListedUpTo200Letters) {
  const auto map = [&](const std::string& name) {
    return "{\"Name\": \"" + name + "\", " + kOnePoint + "}";
  };
  const std::string a(98, 'a'), b(97, 'b'), c(96, 'c');
  EXPECT_EQ(told_of_map("[" + map(a) + "," + map(b) + "," + map("c") + "]", "k"),
            "no colour map `k` (found `" + a + "`, `" + b + "`)");  // 201 letters
  EXPECT_EQ(told_of_map("[" + map(a) + "," + map(c) + "]", "k"),
            "no colour map `k` (found `" + a + "`, `" + c + "`)");
  EXPECT_EQ(told_of_map("[" + map(a) + "," + map(c.substr(1)) + "," + map("d") + "]", "k"),
            "no colour map `k` (found `" + a + "`, `" + c.substr(1) + "`, `d`)");  // 199
  EXPECT_EQ(map_in("[" + map("a") + "," + map("k") + "]", "k").name, "k");
}

}  // namespace
}  // namespace hiac
