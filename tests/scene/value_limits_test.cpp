// The last values that a specification may have, the first that it may not, and what is said then.
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/specification.hpp"
#include "tests/scene/scene_text.hpp"

namespace hiac {
namespace {

/// What is said of the least specification with a line replaced by another; empty: nothing.
std::string limit_complaint(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    parse_scene(text, "view.toml", "", overrides);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string with_line(const std::string& from, const std::string& to) {
  std::string text = kLeast;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

struct LimitRow {
  const char* from;  ///< of the least specification; empty: `to` follows it
  const char* to;
  const char* message;  ///< empty: none
};

void expect_limits(std::initializer_list<LimitRow> rows) {
  for (const LimitRow& row : rows)
    EXPECT_EQ(limit_complaint(*row.from == '\0' ? kLeast + row.to : with_line(row.from, row.to)),
              row.message)
        << row.to;
}

TEST(ValueLimits, OfCameras) {
  expect_limits({
      {"fov = 30", "fov = 1e-9", ""},
      {"fov = 30", "fov = 9.9e-10",
       "view.toml:8: key `camera.fov`: too small (expected at least 1e-09, found 9.9e-10)"},
      {"fov = 30", "fov = 179.99", ""},
      {"fov = 30", "fov = 180",
       "view.toml:8: key `camera.fov`: an angle between 0 and 180 degrees, both excluded, is "
       "expected (found 180)"},
      {"fov = 30", "fov = -1",
       "view.toml:8: key `camera.fov`: an angle between 0 and 180 degrees, both excluded, is "
       "expected (found -1)"},
      {"fov = 30", "",
       "view.toml:4: key `camera.fov`: is missing (a camera of perspective projection needs it)"},
      {"fov = 30", "projection = 'orthographic'",
       "view.toml:4: key `camera.height`: is missing (a camera of orthographic projection needs "
       "it)"},
      {"fov = 30", "projection = 'orthographic'\nheight = 1\nfov = 3",
       "view.toml:10: key `camera.fov`: has no meaning in orthographic projection (remove it)"},
      {"fov = 30", "projection = 'orthographic'\nheight = 1\nclip = [-1, 1]", ""},
      {"fov = 30", "fov = 30\nclip = [0, 1]", ""},
      {"fov = 30", "fov = 30\nclip = [-0.5, 1]",
       "view.toml:9: key `camera.clip`: near is behind the eye (expected at least 0, found -0.5)"},
      {"fov = 30", "fov = 30\nclip = [1, 1]",
       "view.toml:9: key `camera.clip`: near must be below far (found near 1, far 1)"},
      {"up = [0, 0, 1]", "up = [1e-11, 3, -1]", ""},
      {"up = [0, 0, 1]", "up = [1e-12, 3, -1]",
       "view.toml:7: key `camera.up`: parallel to the view direction from `eye` to `look_at`"},
  });
}

TEST(ValueLimits, OfKeyframes) {
  const std::string image = "[image]\nwidth = 4\nheight = 3\n";
  const std::string camera = "eye = [3, 0, 0]\nlook_at = [0, 0, 0]\nup = [0, 0, 1]\nfov = 30\n";
  const auto told = [&](const std::string& first, const std::string& second) {
    return limit_complaint(image + "[[camera]]\n" + first + camera + "[[camera]]\n" + second);
  };
  EXPECT_EQ(told("", "frame = 1\n"),
            "view.toml:4: key `camera.0.frame`: is missing (every keyframe needs it)");
  EXPECT_EQ(told("frame = 0\n", ""),
            "view.toml:10: key `camera.1.frame`: is missing (every keyframe needs it)");
  EXPECT_EQ(told("frame = 2\n", "frame = 3\n"),
            "view.toml:5: key `camera.0.frame`: the first keyframe must be at 0 (found 2)");
  EXPECT_EQ(told("frame = 0\n", "frame = 0\n"),
            "view.toml:11: key `camera.1.frame`: frames must ascend (found 0 after 0)");
  EXPECT_EQ(told("frame = 0\n", "frame = 1\n"), "");
  EXPECT_EQ(told("frame = 0\n", "frame = 100000\n"),
            "view.toml:11: key `camera.1.frame`: out of range (expected 0 to 99999, found 100000)");
  EXPECT_EQ(told("frame = 0\n", "frame = 99999\n"), "");
}

TEST(ValueLimits, OfPictures) {
  expect_limits({
      {"width = 4", "width = 65536", ""},
      {"width = 4", "width = 65537",
       "view.toml:2: key `image.width`: out of range (expected 1 to 65536, found 65537)"},
      {"width = 4\nheight = 3", "width = 32768\nheight = 32768", ""},
      {"width = 4\nheight = 3", "width = 32769\nheight = 32768",
       "view.toml:3: key `image.height`: the image is too large (expected at most 1073741824 "
       "pixels, found 32769 x 32768)"},
      {"", "[edges]\nwidth = 1000", ""},
      {"", "[edges]\nwidth = 1000.5",
       "view.toml:11: key `edges.width`: too large (expected at most 1000, found 1000.5)"},
      {"", "[edges]\nangle = 180", ""},
      {"", "[edges]\nangle = 180.5",
       "view.toml:11: key `edges.angle`: out of range (expected 0 to 180, found 180.5)"},
      {"", "[background]\npattern = 'checker'",
       "view.toml:10: key `background.color2`: is missing (the pattern needs it)"},
      {"", "[background]\npattern = 'grid'\ncolor2 = [0, 0, 0]\nsize = 1", ""},
      {"", "[background]\nsize = 1",
       "view.toml:11: key `background.size`: has no meaning without the pattern \"checker\" or "
       "\"grid\""},
      {"", "[render]\ntolerance = 1e-30", ""},
      {"", "[render]\ntolerance = 9e-31",
       "view.toml:11: key `render.tolerance`: too small (expected at least 1e-30, found 9e-31)"},
      {"", "[render]\nsplat_below = 1073741824", ""},
      {"", "[render]\nsplat_below = 1073741825",
       "view.toml:11: key `render.splat_below`: out of range (expected 0 to 1073741824, found "
       "1073741825)"},
      {"", "[render]\nplanarity = 1", ""},
      {"", "[render]\nplanarity = 1.5",
       "view.toml:11: key `render.planarity`: out of range (expected 0 to 1, found 1.5)"},
  });
}

TEST(ValueLimits, OfColoursAndNumbers) {
  expect_limits({
      {"", "[background]\ncolor = [0, 0, 1e30]", ""},
      {"", "[background]\ncolor = [0, 0, 2e30]",
       "view.toml:11: key `background.color`: too bright (expected at most 1e+30, found 2e+30)"},
      {"", "[background]\ncolor = [-1, 0, 0]",
       "view.toml:11: key `background.color`: a colour is not negative (found -1)"},
      {"", "[volume.color]\nfield = 'p'\npoints = [[0, 0, 0, 1e30]]", ""},
      {"", "[volume.color]\nfield = 'p'\npoints = [[0, 0, 0, 2e30]]",
       "view.toml:12: key `volume.color.points`: too bright (expected at most 1e+30, found "
       "2e+30)"},
      {"", "[volume.extinction]\nfield = 'p'\npoints = [[0, 2e30]]", ""},
      {"", "[volume.extinction]\nfield = 'p'\npoints = [[0, inf]]",
       "view.toml:12: key `volume.extinction.points`: not finite (expected a finite number, found "
       "inf)"},
      {"", "[volume.extinction]\nfield = ''",
       "view.toml:11: key `volume.extinction.field`: empty (expected a string with something in "
       "it)"},
      {"eye = [0, -3, 1]", "eye = [0, -1e100, 1]", ""},
      {"eye = [0, -3, 1]", "eye = [0, -1.5e100, 1]",
       "view.toml:5: key `camera.eye`: too large (expected at most 1e+100 in magnitude, found "
       "-1.5e+100)"},
      {"", "[edges]\nwidth = 1e-100", ""},
      {"", "[edges]\nwidth = 9e-101",
       "view.toml:11: key `edges.width`: too small (expected at least 1e-100, found 9e-101)"},
      {"", "[edges]\nwidth = 0",
       "view.toml:11: key `edges.width`: expected a positive number, found 0"},
      {"", "[skin]\nshininess = 0", ""},
      {"", "[skin]\nshininess = -0.5",
       "view.toml:11: key `skin.shininess`: too small (expected at least 0, found -0.5)"},
  });
}

TEST(ValueLimits, WrongTypesAreNamed) {
  const std::pair<const char*, const char*> types[] = {
      {"{}", "a table"},
      {"[]", "a list"},
      {"''", "a string"},
      {"true", "a truth value"},
      {"1979-05-27", "a date or time"},
      {"07:32:00", "a date or time"},
  };
  for (const auto& [value, name] : types)
    EXPECT_EQ(limit_complaint(with_line("fov = 30", fmt::format("fov = {}", value))),
              fmt::format("view.toml:8: key `camera.fov`: wrong type (expected a number, found {})",
                          name));
  expect_limits({
      {"", "[volume]\nglow = 1",
       "view.toml:11: key `volume.glow`: wrong type (expected a string, found a whole number)"},
      {"", "[volume]\nglow = 1.5",
       "view.toml:11: key `volume.glow`: wrong type (expected a string, found a number)"},
      {"", "[volume.color]\nfield = 'p'\npoints = 1",
       "view.toml:12: key `volume.color.points`: wrong type (expected a list, found a whole "
       "number)"},
      {"", "[[isosurface]]\nfield = 'p'\nvalue = 1\n[light]\n",
       "view.toml:13: key `light`: wrong type (expected a list of tables, found a table)"},
      {"[image]\nwidth = 4\nheight = 3", "light = [{}, 1]\n[image]\nwidth = 4\nheight = 3",
       "view.toml:1: key `light.1`: wrong type (expected a table, found a whole number)"},
  });
}

TEST(ValueLimits, TheLastOverrideOfAKeyIsBlamed) {
  EXPECT_EQ(limit_complaint(kLeast, {"camera.fov=20", "camera.fov=200"}),
            "camera.fov=200: key `camera.fov`: an angle between 0 and 180 degrees, both excluded, "
            "is expected (found 200)");
  EXPECT_EQ(limit_complaint(kLeast, {"camera.fov=200", "camera.eye=[1, 2, 3]"}),
            "camera.fov=200: key `camera.fov`: an angle between 0 and 180 degrees, both excluded, "
            "is expected (found 200)");
  EXPECT_EQ(limit_complaint(kLeast, {"render.tolerance=1e-40", "render.planarity=0"}),
            "render.tolerance=1e-40: key `render.tolerance`: too small (expected at least 1e-30, "
            "found 1e-40)");
  // a key whose name begins alike lies elsewhere
  EXPECT_EQ(limit_complaint(kLeast + "[background]\ncolor = [2e30, 0, 0]\n",
                            {"background.color2=[0, 0, 0]", "background.pattern=checker"}),
            "view.toml:11: key `background.color`: too bright (expected at most 1e+30, found "
            "2e+30)");
}

TEST(ValueLimits, OverridesNeedAKeyOf16PartsAtMost) {
  const auto told = [](const std::string& option) { return limit_complaint(kLeast, {option}); };
  const std::string malformed =
      ": malformed key (expected KEY=VALUE with a key such as camera.fov)";
  for (const char* option :
       {"=3", ".fov=3", "camera.=3", "camera..fov=3", "a b=3", "'a'=3", "a[0]=3"})
    EXPECT_EQ(told(option), option + malformed);
  const std::string sixteen = "a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a";
  EXPECT_EQ(told(sixteen + ".a=3"), sixteen + ".a=3" + malformed);
  EXPECT_THAT(told(sixteen + "=3"), testing::HasSubstr("key `a`: unknown key"));
}

TEST(ValueLimits, KeysAreSuggestedThatDifferByAThirdOfTheirLetters) {
  const auto told = [](const std::string& line) {
    return limit_complaint(kLeast + "[render]\n" + line + "\n");
  };
  EXPECT_EQ(told("tolxxxnce = 1"),
            "view.toml:11: key `render.tolxxxnce`: unknown key; did you mean `tolerance`?");
  const std::string known =
      "unknown key (known here: integration, interpolation, tolerance, splat_below, planarity)";
  EXPECT_EQ(told("toxxxxnce = 1"), "view.toml:11: key `render.toxxxxnce`: " + known);
  const std::string forty = "planarity" + std::string(31, 'x');
  EXPECT_EQ(told(forty + " = 1"), "view.toml:11: key `render." + forty + "`: " + known);
  EXPECT_EQ(told(forty + "x = 1"), "view.toml:11: key `render." + forty + "x`: unknown key");
  // the first of the text, not of the alphabet
  EXPECT_EQ(told("zz = 1\naa = 1"), "view.toml:11: key `render.zz`: " + known);
}

}  // namespace
}  // namespace hiac
