#include <filesystem>
#include <fstream>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/specification.hpp"
#include "tests/scene/scene_text.hpp"

namespace hiac {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Scene parsed(const std::string& text, const std::vector<Override>& overrides = {}) {
  return parse_scene(text, "view.toml", "", overrides).scene;
}

/// The message of the error that the text causes; its code must be `code`.
std::string complaint(const std::string& text, const std::vector<Override>& overrides = {},
                      ExitCode code = ExitCode::input) {
  try {
    parsed(text, overrides);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), code) << error.what();
    return error.what();
  }
  return "no error";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(SceneParser, ReadsTheLeastWithItsDefaults) {
  const Scene scene = parsed(kLeast);
  EXPECT_EQ(scene.image, (ImageSize{4, 3}));
  EXPECT_EQ(scene.camera.projection, Projection::perspective);
  EXPECT_EQ(scene.camera.eye, (std::array<double, 3>{0, -3, 1}));
  EXPECT_EQ(scene.camera.fov, 30);
  EXPECT_FALSE(scene.camera.clip);
  EXPECT_EQ(scene.volume.glow, Glow::chromaticity);
  EXPECT_FALSE(scene.volume.color);
  EXPECT_FALSE(scene.volume.extinction);
  EXPECT_TRUE(scene.isosurfaces.empty());
  EXPECT_FALSE(scene.skin);
  EXPECT_FALSE(scene.edges);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_FALSE(scene.lights[0].direction);
  EXPECT_EQ(scene.background.pattern, BackgroundPattern::solid);
  EXPECT_EQ(scene.render.integration, Integration::exact);
  EXPECT_EQ(scene.render.interpolation, Interpolation::isoparametric);
  EXPECT_EQ(scene.render.tolerance, 1e-9);
  EXPECT_EQ(scene.render.splat_below, 0u);
  EXPECT_EQ(scene.render.planarity, 1e-10);
}

TEST(SceneParser, ReadsEveryKey) {
  const Scene scene = parsed(R"(
[image]
width = 1024
height = 768
[camera]
projection = "orthographic"
eye     = [0.0, -3.0, 1.0]
look_at = [0.0, 0.0, 0.5]
up      = [0.0, 0.0, 1.0]
height = 2.0
clip = [-1, inf]
[volume]
glow = "emission"
[volume.color]
field  = "velocity:magnitude"
points = [[0.0,  0.0, 0.0, 1.0], [1.0,  1.0, 0.0, 0.0], [1, 0, 1, 0]]
[volume.extinction]
field  = "pressure"
points = [[0.0, 0.0], [1.0, 5.0]]
[[isosurface]]
field = "pressure"
value = 0.5
color = [1.0, 0.8, 0.2]
opacity = 0.4
ambient = 0.25
diffuse = 0.75
specular = 0.35
shininess = 31.0
[[isosurface]]
field = "t"
value = -1
[[light]]
direction = [0.3, -1.0, 0.5]
color = [1.0, 1.0, 0.5]
[[light]]
[background]
color = [0.1, 0.0, 0.0]
pattern = "checker"
color2 = [1, 1, 1]
size = 16
[render]
integration = "approximate-unsliced"
interpolation = "polynomial"
tolerance = 1e-6
splat_below = 3
planarity = 0
)");
  EXPECT_EQ(scene.camera.projection, Projection::orthographic);
  EXPECT_EQ(scene.camera.height, 2);
  EXPECT_EQ(*scene.camera.clip,
            (std::array<double, 2>{-1, std::numeric_limits<double>::infinity()}));
  EXPECT_EQ(scene.volume.glow, Glow::emission);
  EXPECT_EQ(scene.volume.color->field, "velocity:magnitude");
  const auto color = scene.volume.color->function();
  EXPECT_EQ(color(0.25), (std::array<double, 3>{0.25, 0, 0.75}));
  EXPECT_EQ(color(1), (std::array<double, 3>{0, 1, 0}));
  EXPECT_EQ(scene.volume.extinction->function()(0.5)[0], 2.5);
  ASSERT_EQ(scene.isosurfaces.size(), 2u);
  EXPECT_EQ(scene.isosurfaces[0],
            (Isosurface{"pressure", 0.5, {1, 0.8, 0.2}, 0.4, 0.25, 0.75, 0.35, 31}));
  EXPECT_EQ(scene.isosurfaces[1], (Isosurface{"t", -1}));
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].direction, (std::array<double, 3>{0.3, -1, 0.5}));
  EXPECT_EQ(scene.background, (Background{BackgroundPattern::checker, {0.1, 0, 0}, {1, 1, 1}, 16}));
  EXPECT_EQ(scene.render, (RenderSettings{Integration::approximate_unsliced,
                                          Interpolation::polynomial, 1e-6, 3, 0}));
}

TEST(SceneParser, NamesFileLineAndKeyOfEveryFault) {
  const struct {
    const char* from;
    const char* to;
    const char* message;
  } cases[] = {
      {"fov = 30", "fov = 180", "view.toml:8: key `camera.fov`: an angle between 0 and 180"},
      {"fov = 30", "fov = 0", "view.toml:8: key `camera.fov`: "},
      {"fov = 30", "fov = nan", "view.toml:8: key `camera.fov`: not a number"},
      {"fov = 30", "fov = '30'",
       "view.toml:8: key `camera.fov`: wrong type (expected a number, found a string)"},
      {"fov = 30", "fov = true",
       "view.toml:8: key `camera.fov`: wrong type (expected a number, found a truth value)"},
      {"fov = 30", "", "view.toml:4: key `camera.fov`: is missing"},
      {"fov = 30", "fov = 30\nheight = 2",
       "view.toml:9: key `camera.height`: has no meaning in perspective projection"},
      {"fov = 30", "projection = 'orthographic'", "view.toml:4: key `camera.height`: is missing"},
      {"fov = 30", "fov = 30\nprojection = 'fisheye'",
       "view.toml:9: key `camera.projection`: no such choice (expected one of perspective, "
       "orthographic, found fisheye)"},
      {"fov", "fow", "view.toml:8: key `camera.fow`: unknown key; did you mean `fov`?"},
      {"fov = 30", "fov = 30\nzoom = 1",
       "view.toml:9: key `camera.zoom`: unknown key (known here: projection, eye,"},
      {"fov = 30", "fov = 30\nclip = [2, 1]", "view.toml:9: key `camera.clip`: near must be below"},
      {"fov = 30", "fov = 30\nclip = [1, 1]", "view.toml:9: key `camera.clip`: near must be below"},
      {"fov = 30", "fov = 30\nclip = [-1, 1]", "view.toml:9: key `camera.clip`: near is behind"},
      {"fov = 30", "fov = 30\nclip = [inf, inf]", "view.toml:9: key `camera.clip`: not finite"},
      {"width = 4", "width = 0", "view.toml:2: key `image.width`: out of range"},
      {"width = 4", "width = -4", "view.toml:2: key `image.width`: out of range"},
      {"width = 4", "width = 4.5", "view.toml:2: key `image.width`: expected a whole number"},
      {"width = 4", "width = 1e99", "view.toml:2: key `image.width`: out of range"},
      {"width = 4", "width = 1e300", "view.toml:2: key `image.width`: too large"},
      {"width = 4\nheight = 3", "width = 65536\nheight = 65536",
       "view.toml:3: key `image.height`: the image is too large"},
      {"width = 4\n", "", "view.toml:1: key `image.width`: is missing"},
      {"eye = [0, -3, 1]", "eye = [0, 0, 0]",
       "view.toml:6: key `camera.look_at`: the same point as `eye`"},
      {"eye = [0, -3, 1]", "eye = [0, 0, 5]",
       "view.toml:7: key `camera.up`: parallel to the view direction"},
      {"up = [0, 0, 1]", "up = [0, 0, 0]", "view.toml:7: key `camera.up`: a direction cannot be"},
      {"up = [0, 0, 1]", "up = [0, 0]", "view.toml:7: key `camera.up`: wrong length"},
      {"up = [0, 0, 1]", "up = [0, 0, 'z']", "view.toml:7: key `camera.up`: wrong type"},
      {"up = [0, 0, 1]", "up = [0, 0, inf]", "view.toml:7: key `camera.up`: not finite"},
      {"eye = [0, -3, 1]\nlook_at = [0, 0, 0]", "eye = [0, -1.7e308, 1]\nlook_at = [0, 1.7e308, 0]",
       "view.toml:5: key `camera.eye`: too large"},
      {"[image]\nwidth = 4\nheight = 3\n", "", "view.toml: key `image`: is missing"},
      {"[camera]", "[camra]", "view.toml:4: key `camra`: unknown key; did you mean `camera`?"},
      {"[image]\n", "image = 3\n[imag]\n", "view.toml:2: key `imag`: unknown key"},
      {"# line 9", "fov = 3", "view.toml:9: "},
      {"# line 9", "[volume", "view.toml:9: "},
  };
  for (const auto& c : cases) {
    EXPECT_THAT(complaint(replaced(kLeast, c.from, c.to)), StartsWith(c.message))
        << c.from << " -> " << c.to;
  }
}

TEST(SceneParser, NamesTheFaultsOfFurtherTables) {
  const struct {
    const char* text;
    const char* message;
  } cases[] = {
      {"[volume.color]\npoints = [[0, 0, 0, 0]]",
       "view.toml:10: key `volume.color.field`: is miss"},
      {"[volume.color]\nfield = ''", "view.toml:11: key `volume.color.field`: empty"},
      {"[volume.color]\nfield = 'p'",
       "view.toml:10: key `volume.color.points`: is missing (one of"},
      {"[volume.color]\nfield = 'p'\npoints = []",
       "view.toml:12: key `volume.color.points`: empty"},
      {"[volume.color]\nfield = 'p'\npoints = [[0, 0, 0, 0],\n[1, 0, 0]]",
       "view.toml:13: key `volume.color.points`: wrong length (expected a list of 4 values, found "
       "3)"},
      {"[volume.color]\nfield = 'p'\npoints = [[0, 0, 0, 0],\n[-1, 0, 0, 0]]",
       "view.toml:13: key `volume.color.points`: scalars must not decrease (point 2 has -1 after "
       "0"},
      {"[volume.color]\nfield = 'p'\npoints = [[0, inf, 0, 0]]",
       "view.toml:12: key `volume.color.points`: not finite"},
      {"[volume.color]\nfield = 'p'\npoints = [[nan, 0, 0, 0]]",
       "view.toml:12: key `volume.color.points`: not a number"},
      {"[volume.color]\nfield = 'p'\npoints = [[0, -1, 0, 0]]",
       "view.toml:12: key `volume.color.points`: too small"},
      {"[volume.color]\nfield = 'p'\npoints = [[0, 0, 0, 0]]\npreset = 'x.json'",
       "view.toml:13: key `volume.color.preset`: one of `points` and `preset` is expected"},
      {"[volume.color]\nfield = 'p'\npreset = 'virids'",
       "view.toml:12: key `volume.color.preset`: no colour map of this name (expected a file, or "
       "one of viridis, plasma"},
      {"[volume.color]\nfield = 'p'\npreset = 'viridis'\npreset_name = 'x'",
       "view.toml:13: key `volume.color.preset_name`: has no meaning without a preset file"},
      {"[volume.color]\nfield = 'p'\npreset = 'viridis'\nrange = 'all'",
       "view.toml:13: key `volume.color.range`: no such range (expected [low, high], \"auto\""},
      {"[volume.color]\nfield = 'p'\npreset = 'viridis'\nrange = 'percentile:9,1'",
       "view.toml:13: key `volume.color.range`: percentiles go from 0 to 100"},
      {"[volume.color]\nfield = 'p'\npreset = 'viridis'\nrange = 'percentile:1,101'",
       "view.toml:13: key `volume.color.range`: percentiles go from 0 to 100"},
      {"[volume.color]\nfield = 'p'\npreset = 'viridis'\nrange = 'percentile:1'",
       "view.toml:13: key `volume.color.range`: no such range"},
      {"[volume.color]\nfield = 'p'\npreset = 'viridis'\nscale = 'ln'",
       "view.toml:13: key `volume.color.scale`: no such choice"},
      {"[volume.color]\nfield = 'p'\npreset = 'viridis'\nscale = 'log'\nrange = [0, 1]",
       "view.toml:14: key `volume.color.range`: a logarithmic scale needs a positive range"},
      {"[volume.color]\nfield = 'p'\nscale = 'log'\npoints = [[0, 0, 0, 0], [1, 1, 1, 1]]",
       "view.toml:13: key `volume.color.points`: a logarithmic scale needs positive scalars"},
      {"[volume.color]\nfield = 'p'\ncolor_space = 'srgb'\npoints = [[0, 2, 0, 0]]",
       "view.toml:13: key `volume.color.points`: a display value is at most 1"},
      {"[volume.extinction]\nfield = 'p'\nrange = 'auto'\npoints = [[0, 2], [3, 0]]",
       "view.toml:13: key `volume.extinction.points`: with `range`, scalars go from 0 to 1"},
      {"[volume.color]\nfield = 'p'\npreset = 'x.json'\nrange = [1, 0]",
       "view.toml:13: key `volume.color.range`: low must be below high"},
      {"[volume.color]\nfield = 'p'\npreset = 'none.json'\nrange = [0, 1]",
       "view.toml:12: key `volume.color.preset`: none.json: cannot be opened"},
      {"[volume.color]\nfield = 'p'\npoints = [[0, 0, 0, 0]]\npreset_name = 'x'",
       "view.toml:13: key `volume.color.preset_name`: has no meaning without `preset`"},
      {"[volume.color]\nfield = 'p'\npoints = [[0, 0, 0, 0]]\npreset_tolerance = 1e-3",
       "view.toml:13: key `volume.color.preset_tolerance`: has no meaning for points"},
      {"[volume.extinction]\nfield = 'p'\npoints = [[0, 1], [1, -0.5]]",
       "view.toml:12: key `volume.extinction.points`: too small (expected at least 0, found -0.5)"},
      {"[volume.extinction]\nfield = 'p'\npoints = 3",
       "view.toml:12: key `volume.extinction.points`: wrong type (expected a list, found a whole"},
      {"[volume]\nglow = 3", "view.toml:11: key `volume.glow`: wrong type"},
      {"[volume]\ncolour = 3", "view.toml:11: key `volume.colour`: unknown key; did you mean `col"},
      {"[[isosurface]]\nfield = 'p'\nvalue = 1\n[[isosurface]]\nfield = 'p'",
       "view.toml:13: key `isosurface.1.value`: is missing"},
      {"[skin]\ncolor = 'red'", "view.toml:11: key `skin.color`: "},
      {"[edges]\nshow = 'none'", "view.toml:11: key `edges.show`: no such choice"},
      {"[edges]\nangle = 181", "view.toml:11: key `edges.angle`: out of range"},
      {"[edges]\nwidth = 0", "view.toml:11: key `edges.width`: expected a positive"},
      {"[edges]\nwidth = 1001", "view.toml:11: key `edges.width`: too large"},
      {"[edges]\nshow = 'all'\nangle = 30", "view.toml:12: key `edges.angle`: has no meaning"},
      {"[skin]\nopacity = 2", "view.toml:11: key `skin.opacity`: out of range"},
      {"[skin]\nwidth = 2", "view.toml:11: key `skin.width`: unknown key"},
      {"[skin.color]\nfield = 'p'", "view.toml:10: key `skin.color.points`: is missing"},
      {"[[isosurface]]\nfield = 'p'\nvalue = 1\nopacity = 1.5",
       "view.toml:13: key `isosurface.0.opacity`: out of range"},
      {"[isosurface]\nfield = 'p'", "view.toml:10: key `isosurface`: wrong type (expected a list"},
      {"[[isosurfaces]]", "view.toml:10: key `isosurfaces`: unknown key; did you mean `isosurface"},
      {"[[light]]\ndirection = [0, 0, 0]", "view.toml:11: key `light.0.direction`: a direction"},
      {"[[light]]\ncolor = [1, 1, -1]", "view.toml:11: key `light.0.color`: a colour is not neg"},
      {"[background]\ncolor2 = [1, 1, 1]", "view.toml:11: key `background.color2`: has no meaning"},
      {"[background]\npattern = 'grid'", "view.toml:10: key `background.color2`: is missing"},
      {"[background]\npattern = 'gradient'\ncolor2 = [0, 0, 0]\nsize = 3",
       "view.toml:13: key `background.size`: has no meaning"},
      {"[background]\npattern = 'grid'\ncolor2 = [0, 0, 0]\nsize = 0",
       "view.toml:13: key `background.size`: expected a positive"},
      {"[render]\ntolerance = 0", "view.toml:11: key `render.tolerance`: expected a positive"},
      {"[render]\nsplat_below = -1", "view.toml:11: key `render.splat_below`: out of range"},
      {"[render]\nintegration = 'monte carlo'", "view.toml:11: key `render.integration`: no such"},
  };
  for (const auto& c : cases)
    EXPECT_THAT(complaint(kLeast + c.text), StartsWith(c.message)) << c.text;
}

TEST(SceneParser, KeepsItsMessagesInOneLine) {
  EXPECT_THAT(complaint(kLeast + "[render]\n\"a\\nb\" = 1"), HasSubstr("`render.a b`"));
}

TEST(SceneParser, AppliesOverridesBeforeInterpreting) {
  const std::string text = kLeast + "[[isosurface]]\nfield = 'p'\nvalue = 1\n";
  const Scene scene =
      parsed(text, {"camera.fov=20.5", "isosurface.0.value=7", "image.width=10", "camera.eye.0=1",
                    "isosurface.0.field=velocity:magnitude", "light.0.color=[1, 0, 0]",
                    "isosurface.1.field=q", "isosurface.1.value=2", "volume.glow=emission",
                    "render.tolerance=1e-3"});
  EXPECT_EQ(scene.camera.fov, 20.5);
  EXPECT_EQ(scene.camera.eye, (std::array<double, 3>{1, -3, 1}));
  EXPECT_EQ(scene.image.width, 10u);
  ASSERT_EQ(scene.isosurfaces.size(), 2u);
  EXPECT_EQ(scene.isosurfaces[0].value, 7);
  EXPECT_EQ(scene.isosurfaces[0].field, "velocity:magnitude");
  EXPECT_EQ(scene.isosurfaces[1].field, "q");
  EXPECT_EQ(scene.lights[0].color, (Color{1, 0, 0}));
  EXPECT_EQ(scene.volume.glow, Glow::emission);
  EXPECT_EQ(scene.render.tolerance, 1e-3);
}

TEST(SceneParser, RemovesAKeyByAnEmptyOverride) {
  const Scene scene =
      parsed(kLeast, {"camera.projection=orthographic", "camera.fov=", "camera.height=2"});
  EXPECT_EQ(scene.camera.projection, Projection::orthographic);
  EXPECT_EQ(scene.camera.height, 2);
}

TEST(SceneParser, BlamesTheOptionForAnOverridesFault) {
  const struct {
    const char* option;
    const char* message;
  } cases[] = {
      {"camera.fov=200", "camera.fov=200: key `camera.fov`: an angle between 0 and 180"},
      {"camera.fov=2x", "camera.fov=2x: key `camera.fov`: wrong type"},
      {"camera.fow=2", "camera.fow=2: key `camera.fow`: unknown key; did you mean `fov`?"},
      {"camera.eye.0=x", "camera.eye.0=x: key `camera.eye`: wrong type"},
      {"camera=3", "camera=3: key `camera`: wrong type (expected a table"},
      {"camera.fov", "camera.fov: expected KEY=VALUE"},
      {"=3", "=3: malformed key"},
      {"camera..fov=3", "camera..fov=3: malformed key"},
      {"camera.eye.7=3", "camera.eye.7=3: no element `7` (the list has 3, counted from 0)"},
      {"camera.eye.x=3", "camera.eye.x=3: no element `x`"},
      {"camera.fov.x=3", "camera.fov.x=3: `x` lies below a plain value"},
      {"isosurface.2.value=3", "isosurface.2.value=3: no element `2` (the list has 0"},
  };
  for (const auto& c : cases)
    EXPECT_THAT(complaint(kLeast, {c.option}, ExitCode::usage), StartsWith(c.message));
}

TEST(SceneParser, TakesAnOverrideAsOneValueOnly) {
  EXPECT_THAT(complaint(kLeast, {"camera.fov=3\nw = 5"}, ExitCode::usage),
              HasSubstr("wrong type (expected a number, found a string)"));
}

TEST(SceneParser, ReadsAFileAndNamesItInErrors) {
  const auto folder = std::filesystem::temp_directory_path() / "hiac_scene_parser_test";
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "view.toml").string();
  std::ofstream(folder / "map.json")
      << R"([{"Name": "m", "ColorSpace": "RGB", "RGBPoints": [0, 0, 0, 0, 4, 1, 0, 1]}])";
  std::ofstream(path) << kLeast
                      << "[volume.color]\nfield = 'p'\npreset = 'map.json'\nrange = [10, 12]\n"
                         "color_space = 'linear'\n";
  const ParsedScene read = read_scene(path);
  EXPECT_EQ(read.scene.volume.color->function()(11), (Color{0.5, 0, 0.5}));
  ASSERT_EQ(read.notes.size(), 1u);
  EXPECT_THAT(read.notes[0], HasSubstr("colour map m as 2 points"));
  std::filesystem::remove_all(folder);
  try {
    read_scene(path);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), StartsWith(path + ": cannot be opened"));
  }
  EXPECT_THROW(read_scene(std::filesystem::temp_directory_path().string()), InputError);
}

TEST(SceneParser, SurvivesKeysNestedDeep) {
  std::string dotted = "a";
  for (int i = 0; i < 300000; ++i) dotted += ".a";
  EXPECT_THAT(complaint(dotted + " = 1"), HasSubstr("view.toml:1: a key of more than 32 parts"));
  EXPECT_THAT(complaint("[" + dotted + "]"), HasSubstr("a key of more than 32 parts"));
  EXPECT_THAT(complaint("\n\"\\\"\"." + dotted + " = 1"), HasSubstr("view.toml:2: "));
  EXPECT_THAT(complaint("x = " + std::string(100000, '[')), StartsWith("view.toml:1: "));
  // dots in strings and in comments are just text
  const std::string dots(100, '.');
  EXPECT_EQ(parsed(kLeast + "# " + dots + "\n[[isosurface]]\nvalue = 0\nfield = '" + dots + "'")
                .isosurfaces[0]
                .field,
            dots);
}

TEST(SceneParser, SurvivesMutatedText) {
  const std::string whole = to_toml(parsed(kLeast + "[[isosurface]]\nfield = 'p'\nvalue = 1\n"));
  std::mt19937 random(7);
  const std::string alphabet = "[]{}=.,\"'#\n\\0159aeinf-+_ \xff";
  for (int trial = 0; trial < 3000; ++trial) {
    std::string text = whole;
    for (unsigned edits = random() % 4 + 1; edits > 0; --edits) {
      const std::size_t at = random() % text.size();
      if (random() % 3 == 0)
        text.erase(at, random() % 20);
      else
        text[at] = alphabet[random() % alphabet.size()];
      if (text.empty()) text.push_back(' ');
    }
    try {
      parsed(text);
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

TEST(ViewHash, KeepsToWhatDecidesTheOrder) {
  Scene scene;
  scene.camera = {Projection::perspective, {1, 2, 3}, {4, 5, 6}, {0, 0, 1}, 30, 0, {}};
  const std::string hash = view_hash(scene);
  EXPECT_EQ(hash.size(), 32u);
  Scene other = scene;
  other.camera.look_at = {7, 8, 9};
  other.camera.fov = 20;
  other.camera.up = {1, 0, 0};
  other.image = {7, 5};
  other.render.tolerance = 1e-3;
  EXPECT_EQ(view_hash(other), hash);
  other.camera.eye[0] += 1e-15;
  EXPECT_NE(view_hash(other), hash);

  scene.camera.projection = Projection::orthographic;
  EXPECT_NE(view_hash(scene), hash);
  other = scene;
  other.camera.eye = {11, 12, 13};
  other.camera.look_at = {20, 21, 22};  // the same direction, three times as long
  EXPECT_EQ(view_hash(other), view_hash(scene));
  other.camera.look_at = {2, 3, 4};  // the other way
  EXPECT_NE(view_hash(other), view_hash(scene));
}

// What counts as planar decides about arrows of faces that are seen edge-on.
TEST(ViewHash, KnowsThePlanarity) {
  Scene scene;
  Scene other = scene;
  other.render.planarity = 1e-6;
  EXPECT_NE(view_hash(other), view_hash(scene));
}

TEST(ViewHash, TheTwoZerosAreOne) {
  Scene zero;
  zero.camera = {Projection::perspective, {0.0, 1, 1}, {0, 0, 0}, {0, 0, 1}, 30, 0, {}};
  zero.render.planarity = 0.0;
  Scene minus_zero = zero;
  minus_zero.camera.eye[0] = -0.0;
  minus_zero.render.planarity = -0.0;
  EXPECT_EQ(view_hash(zero), view_hash(minus_zero));
}

}  // namespace
}  // namespace hiac
