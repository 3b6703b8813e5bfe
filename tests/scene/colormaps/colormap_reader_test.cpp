#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/colormaps/colormap_preset.hpp"

namespace hiac {
namespace {

using testing::HasSubstr;

class ColormapReader : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  ColormapPreset read(const std::string& text, const std::optional<std::string>& name = {}) {
    std::ofstream(path_) << text;
    return read_colormap_preset(path_, name);
  }

  std::string complaint(const std::string& text, const std::optional<std::string>& name = {}) {
    try {
      read(text, name);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path_ + ": "));
      return error.what();
    }
    return "no error";
  }

  const std::string path_ =
      (std::filesystem::temp_directory_path() /
       (std::string("hiac_") + testing::UnitTest::GetInstance()->current_test_info()->name()))
          .string();
};

const char* const kTwoMaps = R"([
  {"ColorSpace" : "Diverging", "Name" : "Cool, to ] Warm", "NanColor" : [1, 1, 0,],
   "RGBPoints" : [ 0, 0.231373, 0.298039, 0.752941,
                   0.5, 0.865003, 0.865003, 0.865003,
                   1, 0.705882, 0.0156863, 0.14902, ],
  },
  {"ColorSpace" : "HSV", "HSVWrap" : true, "Name" : "\", }", "RGBPoints" : [2, 1, 0, 0, 1, 0, 0, 1]}
 ,
])";

TEST_F(ColormapReader, ReadsJsonWithTrailingCommas) {
  const ColormapPreset preset = read(kTwoMaps);
  EXPECT_EQ(preset.name, "Cool, to ] Warm");
  EXPECT_EQ(preset.space, ColorSpace::diverging);
  ASSERT_EQ(preset.nodes.size(), 3u);
  EXPECT_EQ(preset.nodes[2].rgb, (std::array<double, 3>{0.705882, 0.0156863, 0.14902}));
}

TEST_F(ColormapReader, ChoosesAMapByNameAndSortsItsPoints) {
  const ColormapPreset preset = read(kTwoMaps, "\", }");
  EXPECT_EQ(preset.space, ColorSpace::hsv_wrapped);
  ASSERT_EQ(preset.nodes.size(), 2u);
  EXPECT_EQ(preset.nodes[0].scalar, 1);
  EXPECT_THAT(complaint(kTwoMaps, "Jet"),
              HasSubstr("no colour map `Jet` (found `Cool, to ] Warm`"));
}

TEST_F(ColormapReader, ReadsOneMapWithoutAList) {
  EXPECT_EQ(read(R"({"RGBPoints": [0, 0, 0, 0]})").space, ColorSpace::rgb);
}

TEST_F(ColormapReader, KnowsTheNamesOfSpaces) {
  const std::pair<const char*, ColorSpace> spaces[] = {
      {"RGB", ColorSpace::rgb},  {"HSV", ColorSpace::hsv},    {"Wrapped", ColorSpace::hsv_wrapped},
      {"Lab", ColorSpace::lab},  {"CIELAB", ColorSpace::lab}, {"Diverging", ColorSpace::diverging},
      {"Step", ColorSpace::step}};
  for (const auto& [name, space] : spaces)
    EXPECT_EQ(
        read(std::string(R"([{"ColorSpace":")") + name + R"(", "RGBPoints": [0, 0, 0, 0]}])").space,
        space);
}

TEST_F(ColormapReader, ReadsXml) {
  const ColormapPreset preset = read(
      "<?xml version=\"1.0\"?>\n<ColorMaps>"
      "<ColorMap name=\"a\" space=\"Lab\"><Point x=\"0\" o=\"0\" r=\"0\" g=\"0.5\" b=\"1\"/>"
      "<Point x=\"1.5\" o=\"1\" r=\"1\" g=\"0\" b=\"0\"/><NaN r=\"1\" g=\"1\" b=\"0\"/></ColorMap>"
      "</ColorMaps>");
  EXPECT_EQ(preset.name, "a");
  EXPECT_EQ(preset.space, ColorSpace::lab);
  ASSERT_EQ(preset.nodes.size(), 2u);
  EXPECT_EQ(preset.nodes[1].scalar, 1.5);
  EXPECT_EQ(read("<ColorMap space='Step'><Point x='1' r='0' g='0' b='0'/></ColorMap>").space,
            ColorSpace::step);
}

TEST_F(ColormapReader, RefusesWhatIsNoMapOfScalars) {
  const std::pair<std::string, const char*> cases[] = {
      {"", "malformed JSON"},
      {"[", "malformed JSON"},
      {"[]", "holds no colour map"},
      {"3", "holds no colour map"},
      {std::string(1000, '['), "nested too deep"},
      {R"([{"Name": "k", "IndexedColors": [1, 0, 0]}])", "`k`: holds indexed colours"},
      {R"([{"Name": "k"}])", "`k`: holds no points"},
      {R"([{"RGBPoints": [0, 0, 0]}])", "found 3 numbers"},
      {R"([{"RGBPoints": [0, 0, 0, "a"]}])", "holds something but numbers"},
      {R"([{"RGBPoints": {}}])", "not a list"},
      {R"([{"RGBPoints": [0, 0, 0, 2]}])", "a colour is out of range (expected 0 to 1, found 2)"},
      {R"([{"RGBPoints": [1e999, 0, 0, 1]}])", "malformed JSON"},
      {R"([{"RGBPoints": [-1e308, 0, 0, 1, 1e308, 0, 0, 0]}])", "range is not finite"},
      {R"([{"ColorSpace": "Lab/CIEDE2000", "RGBPoints": [0, 0, 0, 0]}])", "space not known"},
      {"<ColorMap><Point x='a' r='0' g='0' b='0'/></ColorMap>", "needs a number `x`"},
      {"<ColorMap><Point x='0' r='0' g='0'/></ColorMap>", "needs a number `b`"},
      {"<ColorMap indexedLookup='true'><Point x='0' r='0' g='0' b='0'/></ColorMap>", "indexed"},
      {"<ColorMaps>", "malformed XML"},
      {"<ColorMaps/>", "holds no colour map"},
  };
  for (const auto& [text, message] : cases)
    EXPECT_THAT(complaint(text), HasSubstr(message)) << text;
  EXPECT_THROW(read_colormap_preset("/nowhere/map.json"), InputError);
}

}  // namespace
}  // namespace hiac
