// Views of ParaView against what ParaView 5.11 itself computes for the same states
// (make_states.py).

#include "hiac/scene/paraview/paraview_view.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/colormaps/color_space.hpp"
#include "hiac/scene/specification.hpp"
#include "hiac/scene/transfer_scale.hpp"
#include "tests/scene/paraview/state_truth.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

ParaviewView view_of(const std::string& name) { return view_from_state(state_file(name)); }

ParsedScene parsed(const std::string& name, std::vector<Override> overrides = {}) {
  return parse_scene(view_of(name).text, name, "", overrides);
}

/// Where a camera shows a point: pixels from the picture's left upper corner. Written from the
/// camera's definition alone.
std::array<double, 2> position_on(const Scene& scene, const std::array<double, 3>& point) {
  const Camera& c = scene.camera;
  using V = std::array<double, 3>;
  const auto minus = [](const V& a, const V& b) {
    return V{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  const auto dot = [](const V& a, const V& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const auto cross = [](const V& a, const V& b) {
    return V{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const auto unit = [&](const V& a) {
    const double length = std::sqrt(dot(a, a));
    return V{a[0] / length, a[1] / length, a[2] / length};
  };
  const V ahead = unit(minus(c.look_at, c.eye));
  const V right = unit(cross(ahead, c.up));
  const V up = cross(right, ahead);
  const V to = minus(point, c.eye);
  const double height = c.projection == Projection::orthographic
                            ? c.height
                            : 2 * dot(to, ahead) * std::tan(c.fov / 2 * std::acos(-1.0) / 180);
  const double scale = scene.image.height / height;  // pixels per world unit
  return {scene.image.width / 2.0 + scale * dot(to, right),
          scene.image.height / 2.0 - scale * dot(to, up)};
}

class State : public testing::TestWithParam<const char*> {};

TEST_P(State, ShowsTheCornersOfTheBoxWhereParaViewDoes) {
  const Scene scene = parsed(GetParam() + std::string(".pvsm")).scene;
  const auto corners = truth<5>(GetParam(), "corner");
  ASSERT_EQ(corners.size(), 8);
  for (const auto& [x, y, z, right, down] : corners) {
    const auto at = position_on(scene, {x, y, z});
    EXPECT_NEAR(at[0], right, 0.01);
    EXPECT_NEAR(at[1], down, 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(ParaView, State,
                         testing::Values("rgb", "hsv0", "hsv1", "lab", "diverging", "step",
                                         "ciede2000", "log", "table", "logtable", "magnitude",
                                         "component", "separate", "sharp", "resample", "surfaces",
                                         "views"));

TEST(ParaviewView, HasThePictureOfTheView) {
  const Scene scene = parsed("component.pvsm").scene;
  EXPECT_EQ(scene.image, (ImageSize{300, 200}));
  EXPECT_EQ(scene.camera.projection, Projection::orthographic);
  EXPECT_EQ(scene.camera.height, 6.5);  // twice the parallel scale
  EXPECT_EQ(scene.background.pattern, BackgroundPattern::gradient);
  const auto linear = color_space::gamma_decoded<double>;
  EXPECT_EQ(scene.background.color, (Color{linear(0.1), linear(0.2), linear(0.3)}));  // top
  EXPECT_EQ(scene.background.color2, (Color{linear(0.8), linear(0.7), linear(0.6)}));
  EXPECT_EQ(scene.volume.color->field, "velocity@cell:1");
  EXPECT_EQ(scene.volume.extinction->field, "velocity@cell:1");
  EXPECT_EQ(parsed("rgb.pvsm").scene.background.color,
            (Color{linear(0.32), linear(0.34), linear(0.43)}));  // the palette's
}

TEST(ParaviewView, NamesTheFieldsOfItsArrays) {
  const Scene separate = parsed("separate.pvsm").scene;
  EXPECT_EQ(separate.volume.color->field, "RTData@node:value");
  EXPECT_EQ(separate.volume.extinction->field, "velocity@node:0");
  EXPECT_EQ(parsed("magnitude.pvsm").scene.volume.color->field, "velocity@node:value");
}

TEST(ParaviewView, FollowsTheLawOfEveryMapper) {
  EXPECT_THAT(view_of("rgb.pvsm").notes,
              Contains(AllOf(HasSubstr("extinction: opacity / "), HasSubstr("Projected tetra"))));
  EXPECT_THAT(view_of("hsv0.pvsm").notes,
              Contains(AllOf(HasSubstr("extinction: opacity / "), HasSubstr("Z sweep"))));
  EXPECT_THAT(view_of("hsv1.pvsm").notes,
              Contains(AllOf(HasSubstr("extinction: opacity / "), HasSubstr("Bunyk ray cast"))));
  EXPECT_THAT(view_of("resample.pvsm").notes,
              Contains(AllOf(HasSubstr("-ln(1 - opacity) / 0.7"), HasSubstr("infinite"))));
}

TEST(ParaviewView, GivesColoursAndExtinctionsThroughTheSpecification) {
  for (const std::string name : {"rgb", "lab", "log"}) {
    const Scene scene = parsed(name + ".pvsm", {"volume.color.preset_tolerance=1e-6"}).scene;
    const auto color = scene.volume.color->function();
    for (const auto& [scalar, r, g, b] : truth<4>(name, "color")) {
      if (scalar == 2) continue;  // a step of 1e-4 (color_function_test.cpp)
      const auto linear = color(scalar);
      const std::array<double, 3> expected{r, g, b};
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(color_space::gamma_encoded(linear[c]), expected[c], 2e-5) << name << scalar;
    }
    const auto extinction = scene.volume.extinction->function();
    const double unit = std::sqrt(48.0) / std::cbrt(320.0);  // box diagonal, cells
    for (const auto& [scalar, opacity] : truth<2>(name, "opacity"))
      EXPECT_NEAR(extinction(scalar)[0] * unit, opacity, 2e-4) << name << scalar;
  }
}

TEST(ParaviewView, DrawsContoursAndListsWhatHasNoEqual) {
  const ParaviewView view = view_of("surfaces.pvsm");
  const Scene scene = parse_scene(view.text, "surfaces").scene;
  ASSERT_EQ(scene.isosurfaces.size(), 3);
  const Isosurface& first = scene.isosurfaces[0];
  EXPECT_EQ(first.field, "RTData@node:value");
  EXPECT_EQ(first.value, 120);
  EXPECT_EQ(scene.isosurfaces[1].value, 180);
  EXPECT_EQ(first.opacity, 0.4);
  EXPECT_EQ(first.specular, 0.3);
  EXPECT_EQ(first.shininess, 40);
  EXPECT_NEAR(color_space::gamma_encoded(first.color[1]), 0.5, 1e-12);
  // the colour of its own value, halfway between the second and the third node
  EXPECT_EQ(scene.isosurfaces[2].value, 150);
  EXPECT_THAT(view.omitted, Contains(HasSubstr("Slice1 (Cut) as Surface")));
  EXPECT_THAT(view.omitted, Contains(HasSubstr("the shading of surfaces")));
  EXPECT_THAT(view.notes, Contains(HasSubstr("the five of the light kit")));
  EXPECT_THAT(view.text, HasSubstr("# not as in ParaView: Slice1"));
}

TEST(ParaviewView, TakesTheFirstViewOrTheOneThatIsNamed) {
  EXPECT_THAT(view_of("views.pvsm").notes, Contains(HasSubstr("the first of ")));
  EXPECT_EQ(parsed("views.pvsm#Second").scene.image, (ImageSize{120, 90}));
  EXPECT_THROW(view_of("views.pvsm#Third"), UsageError);
}

TEST(ParaviewView, FindsTheDataBesideTheState) {
  EXPECT_EQ(view_of("rgb.pvsm").data_file, state_file("block.vtu"));
}

// Every light of vtkLightKit (make_lights.py) is there once.
void expect_lights(const Scene& scene, const std::string& kit, double tolerance) {
  auto expected = truth<6>("lights", kit);
  ASSERT_EQ(scene.lights.size(), expected.size());
  for (const Light& light : scene.lights) {
    ASSERT_TRUE(light.direction);
    const auto found = std::ranges::find_if(expected, [&](const auto& e) {
      double farthest = 0;
      for (std::size_t c = 0; c < 3; ++c)
        farthest = std::max({farthest, std::abs((*light.direction)[c] - e[c]),
                             std::abs(light.color[c] - e[c + 3])});
      return farthest <= tolerance;
    });
    ASSERT_NE(found, expected.end()) << (*light.direction)[0] << " " << light.color[0];
    expected.erase(found);
  }
}

TEST(ParaviewView, HasTheLightsOfTheLightKit) {
  expect_lights(parsed("surfaces.pvsm").scene, "usual", 1e-8);
  // lights shine on surfaces alone
  EXPECT_EQ(parsed("rgb.pvsm").scene.lights, std::vector<Light>{Light{}});
}

// Changes -----------------------------------------------------------------------------------------

class ChangedState : public testing::Test {
 protected:
  /// The message for rgb.pvsm with a text replaced by another.
  std::string message(const std::string& from, const std::string& to) {
    std::ifstream file(state_file("rgb.pvsm"));
    std::string text((std::istreambuf_iterator<char>(file)), {});
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    return message_of(text);
  }

  /// surfaces.pvsm with other values of its properties.
  std::string surfaces_with(const std::map<std::string, std::string>& values) {
    std::ifstream file(state_file("surfaces.pvsm"));
    std::string text((std::istreambuf_iterator<char>(file)), {});
    for (const auto& [property, value] : values) {
      const std::string begin = "value=\"";
      std::size_t at = text.find("<Property name=\"" + property + "\"");
      EXPECT_NE(at, std::string::npos) << property;
      at = text.find(begin, at) + begin.size();
      text.replace(at, text.find('"', at) - at, value);
    }
    return text;
  }

  std::string message_of(const std::string& text) {
    const std::string path = folder_.file("damaged.pvsm");
    std::ofstream(path) << text;
    try {
      const std::string spec = view_from_state(path).text;
      parse_scene(spec, "spec");
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
      return error.what();
    }
    return "";
  }

  ScratchFolder folder_;
};

TEST_F(ChangedState, IsRefusedWithTheProperty) {
  EXPECT_THAT(message_of("<a>"), HasSubstr("malformed XML"));
  EXPECT_THAT(message_of("<a/>"), HasSubstr("found <a>"));
  EXPECT_THAT(message_of("<ServerManagerState/>"), HasSubstr("no render view"));
  EXPECT_THAT(message("name=\"ColorSpace\"", "name=\"Gone\""), IsEmpty());  // unknown: ignored
  EXPECT_THAT(message("name=\"RGBPoints\"", "name=\"Gone\""), HasSubstr("RGBPoints"));
  EXPECT_THAT(message("name=\"Points\"", "name=\"Gone\""), HasSubstr("Points"));
  EXPECT_THAT(message("name=\"CameraPosition\"", "name=\"Gone\""), HasSubstr("CameraPosition"));
  EXPECT_THAT(message("<Element index=\"0\" value=\"300\"", "<Element index=\"0\" value=\"3e9\""),
              HasSubstr("ViewSize"));
  EXPECT_THAT(message("value=\"Projected tetra\"", "value=\"Marching\""), HasSubstr("Marching"));
}

TEST_F(ChangedState, NamesAFilterWhoseOutputTheVolumeShows) {
  EXPECT_THAT(message("<Proxy group=\"sources\" type=\"XMLUnstructuredGridReader\"",
                      "<Proxy group=\"filters\" type=\"Threshold\""),
              HasSubstr("filter XMLUnstructuredGridReader1 (Threshold)"));
}

TEST_F(ChangedState, MayShowTheDatasSurface) {
  std::ifstream state(state_file("rgb.pvsm"));
  std::string text((std::istreambuf_iterator<char>(state)), {});
  const std::string volume = "value=\"Volume\"";
  text.replace(text.find(volume), volume.size(), "value=\"Surface With Edges\"");
  const std::string path = folder_.write("surface.pvsm", text);
  const ParaviewView view = view_from_state(path);
  const Scene scene = parse_scene(view.text, "surface").scene;
  EXPECT_FALSE(scene.volume.color);
  EXPECT_FALSE(scene.volume.extinction);
  ASSERT_TRUE(scene.skin && scene.skin->color_by && scene.edges);
  EXPECT_EQ(scene.skin->color_by->field, "RTData@node:value");
  EXPECT_EQ(scene.skin->opacity, 1);
  EXPECT_EQ(scene.skin->diffuse, 1);
  EXPECT_EQ(scene.edges->show, EdgeChoice::boundary);
  EXPECT_EQ(scene.edges->width, 1);
  EXPECT_NEAR(color_space::gamma_encoded(scene.edges->color[2]), 0.5, 1e-12);
}

TEST_F(ChangedState, MayHaveOtherLights) {
  const std::map<std::string, std::string> other{
      {"KeyLightIntensity", "1.25"}, {"KeyLightWarmth", "0.9"},     {"KeyLightElevation", "20"},
      {"KeyLightAzimuth", "-35"},    {"FillLightK:F Ratio", "2.5"}, {"FillLightWarmth", "0.07"},
      {"FillLightElevation", "-60"}, {"FillLightAzimuth", "25"},    {"BackLightK:B Ratio", "6"},
      {"BackLightWarmth", "0.31"},   {"BackLightElevation", "15"},  {"BackLightAzimuth", "140"},
      {"HeadLightK:H Ratio", "4.5"}, {"HeadLightWarmth", "1"},      {"MaintainLuminance", "1"}};
  const auto scene_of = [&](const std::map<std::string, std::string>& values) {
    const std::string path = folder_.write("lights.pvsm", surfaces_with(values));
    return parse_scene(view_from_state(path).text, "lights").scene;
  };
  // VTK tabulates roots of luminances, to 4 digits
  expect_lights(scene_of(other), "other", 3e-4);
  const Scene dark = scene_of({{"UseLight", "0"}});
  ASSERT_EQ(dark.lights.size(), 1);
  EXPECT_EQ(dark.lights[0].color, Color{});
  EXPECT_THAT(message_of(surfaces_with({{"KeyLightWarmth", "1.5"}})),
              HasSubstr("KeyLightWarmth: expected 0 to 1, found 1.5"));
  EXPECT_THAT(message_of(surfaces_with({{"BackLightK:B Ratio", "0"}})), HasSubstr("BackLightK:B"));
  EXPECT_THAT(message_of(surfaces_with({{"KeyLightIntensity", "-1"}})),
              HasSubstr("KeyLightIntensity"));
}

TEST_F(ChangedState, MayBeACamera) {
  const std::string path = folder_.file("a.pvcc");
  std::ofstream(path) << "<?xml version=\"1.0\"?>\n<PVCameraConfiguration version=\"1.0\"><Proxy>"
                         "<Property name=\"CameraPosition\"><Element index=\"0\" value=\"1\"/>"
                         "<Element index=\"1\" value=\"2\"/><Element index=\"2\" value=\"3\"/>"
                         "</Property><Property name=\"CameraFocalPoint\"><Element value=\"0\"/>"
                         "<Element value=\"0\"/><Element value=\"0\"/></Property>"
                         "<Property name=\"CameraViewUp\"><Element value=\"0\"/>"
                         "<Element value=\"0\"/><Element value=\"1\"/></Property>"
                         "<Property name=\"CameraViewAngle\"><Element value=\"25\"/></Property>"
                         "</Proxy></PVCameraConfiguration>";
  const ParaviewView view = view_from_state(path);
  EXPECT_TRUE(view.is_camera_file);
  const Camera camera = parse_scene(view.text, "a").scene.camera;
  EXPECT_EQ(camera.eye, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(camera.fov, 25);
}

}  // namespace
}  // namespace hiac::test
