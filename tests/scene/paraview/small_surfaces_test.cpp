// Surfaces, contours and curves of opacity in states of ParaView made by hand.
#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/paraview/paraview_view.hpp"
#include "hiac/scene/specification.hpp"
#include "tests/scene/paraview/small_state.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class SmallSurfaces : public testing::Test {
 protected:
  /// A state with a contour of the source, coloured by the contoured array.
  static SmallState contour() {
    SmallState state;
    state.add(6, "filters", "Contour",
              {{"Input", {"@1"}},
               {"SelectInputScalars", {"", "", "", "0", "t"}},
               {"ContourValues", {"1", "1.5"}}});
    state.add(7, "representations", "GeometryRepresentation",
              {{"Input", {"@6"}},
               {"Representation", {"Surface"}},
               {"ColorArrayName", {"", "", "", "0", "t"}},
               {"LookupTable", {"@4"}},
               {"DiffuseColor", {"1", "0", "0"}}});
    state.set(SmallState::view, "Representations", {"@7"});
    return state;
  }
  ParaviewView surface_view(const SmallState& state) {
    return view_from_state(folder_.write("a.pvsm", state.text()));
  }
  Scene surface_scene(const SmallState& state) {
    return parse_scene(surface_view(state).text, "spec").scene;
  }

  ScratchFolder folder_;
};

TEST_F(SmallSurfaces, ContoursHaveTheColoursOfTheirValues) {
  const Scene scene = surface_scene(contour());
  ASSERT_EQ(scene.isosurfaces.size(), 2U);
  EXPECT_EQ(scene.isosurfaces[0].field, "t@node:value");
  EXPECT_EQ(scene.isosurfaces[1].value, 1.5);
  EXPECT_NEAR(scene.isosurfaces[0].color[0], 0.214, 0.001);  // display values 0.5 and 0.75
  EXPECT_NEAR(scene.isosurfaces[1].color[2], 0.523, 0.001);
  EXPECT_EQ(scene.isosurfaces[0].opacity, 1);
  EXPECT_EQ(scene.isosurfaces[0].ambient, 0);
  EXPECT_EQ(scene.isosurfaces[0].diffuse, 1);
  EXPECT_EQ(scene.isosurfaces[0].specular, 0);
  EXPECT_EQ(scene.isosurfaces[0].shininess, 100);
}

TEST_F(SmallSurfaces, ContoursColouredByAnotherArrayAreSolid) {
  SmallState other = contour();
  other.set(7, "ColorArrayName", {"", "", "", "0", "u"});
  EXPECT_EQ(surface_scene(other).isosurfaces[0].color, (Color{1, 0, 0}));
  EXPECT_THAT(surface_view(other).omitted,
              Contains("Contour: its colours by u have no equal here, its solid colour is drawn"));
  SmallState plain = contour();
  plain.set(7, "LookupTable", {});
  EXPECT_EQ(surface_scene(plain).isosurfaces[0].color, (Color{1, 0, 0}));
  EXPECT_THAT(surface_view(plain).omitted, Not(Contains(HasSubstr("its solid colour"))));
  SmallState lost = contour();
  lost.set(7, "LookupTable", {"@99"});
  EXPECT_THROW(surface_view(lost), InputError);
}

TEST_F(SmallSurfaces, WhatIsDrawnOtherwiseIsTold) {
  SmallState state = contour();
  state.set(7, "Opacity", {"0.5"});
  state.set(7, "Representation", {"Surface With Edges"});
  EXPECT_THAT(
      surface_view(state).omitted,
      ElementsAre("Contour: is as opaque from everywhere in ParaView, and more so edge-on here",
                  "Contour: the edges of its triangles", HasSubstr("the shading of surfaces")));
  EXPECT_EQ(surface_scene(state).isosurfaces[0].opacity, 0.5);
  state.set(7, "Opacity", {"1"});
  EXPECT_THAT(surface_view(state).omitted, Not(Contains(HasSubstr("opaque"))));
}

TEST_F(SmallSurfaces, ContoursOfFiltersOrOtherFilesAreLeftOut) {
  SmallState filtered = contour();
  filtered.add(8, "filters", "Clip", {});
  filtered.set(6, "Input", {"@8"});
  EXPECT_THROW(surface_view(filtered), InputError);  // nothing else is shown
  SmallState both = contour();
  both.add(8, "sources", "ExodusIIReader", {});
  both.set(6, "Input", {"@8"});
  both.set(SmallState::view, "Representations", {"@7", "@3"});
  EXPECT_TRUE(surface_scene(both).isosurfaces.empty());
  EXPECT_TRUE(surface_scene(both).volume.color);
  EXPECT_THAT(surface_view(both).omitted,
              ElementsAre("Contour (Contour) as Surface: has no equal here and is not drawn"));
  SmallState one = contour();
  one.set(SmallState::view, "Representations", {"@7", "@3"});
  EXPECT_EQ(surface_scene(one).isosurfaces.size(), 2U);
}

TEST_F(SmallSurfaces, OneSurfaceOfTheDataIsTheSkin) {
  SmallState state;
  state.set(SmallState::shown, "Representation", {"Surface"});
  state.set(SmallState::shown, "Opacity", {"0.25"});
  const Scene colored = surface_scene(state);
  EXPECT_EQ(colored.skin->color_by->field, "t@node:value");
  EXPECT_EQ(colored.skin->opacity, 0.25);
  EXPECT_FALSE(colored.edges);
  EXPECT_THAT(surface_view(state).omitted,
              Contains("the surface: is as opaque from everywhere in ParaView, and more so edge-on "
                       "here"));
  state.set(SmallState::shown, "ColorArrayName", {"", "", "", "0", ""});
  state.set(SmallState::shown, "DiffuseColor", {"0", "1", "0"});
  EXPECT_FALSE(surface_scene(state).skin->color_by);
  EXPECT_EQ(surface_scene(state).skin->color, (Color{0, 1, 0}));
  state.add(8, "representations", "GeometryRepresentation",
            {{"Input", {"@1"}}, {"Representation", {"Surface"}}});
  state.set(SmallState::view, "Representations", {"@3", "@8"});
  EXPECT_THAT(surface_view(state).omitted,
              Contains("XMLUnstructuredGridReader (XMLUnstructuredGridReader) as Surface: has no "
                       "equal here and is not drawn"));
}

TEST_F(SmallSurfaces, EdgesHaveTheirWidthAndColour) {
  SmallState state;
  state.set(SmallState::shown, "Representation", {"Surface With Edges"});
  state.set(SmallState::shown, "LineWidth", {"3"});
  state.set(SmallState::shown, "EdgeColor", {"0", "0", "1"});
  const Scene scene = surface_scene(state);
  EXPECT_EQ(scene.edges->show, EdgeChoice::boundary);
  EXPECT_EQ(scene.edges->width, 3);
  EXPECT_EQ(scene.edges->color, (Color{0, 0, 1}));
}

TEST_F(SmallSurfaces, LightsAreToldOf) {
  SmallState state = contour();
  EXPECT_THAT(surface_view(state).notes,
              Contains("lights: none, as the view has its light kit switched off"));
  state.set(SmallState::view, "UseLight", {"1"});
  state.set(SmallState::view, "StereoRender", {"1"});
  state.set(SmallState::view, "AdditionalLights", {"@9"});
  EXPECT_THAT(surface_view(state).notes,
              Contains("lights: the five of the light kit, as this camera has them"));
  EXPECT_THAT(surface_view(state).omitted,
              ElementsAre("stereo: one picture is drawn",
                          "additional lights: have no equal here, and do not shine",
                          HasSubstr("the shading of surfaces")));
}

TEST_F(SmallSurfaces, DataAreWhereTheStateSaysOrBesideIt) {
  SmallState state;
  const auto data_file = [&] { return surface_view(state).data_file; };
  EXPECT_EQ(data_file(), "none.vtu");
  state.set(SmallState::source, "FileName", {"/nowhere/there.vtu"});
  EXPECT_EQ(data_file(), "/nowhere/there.vtu");
  static_cast<void>(folder_.write("there.vtu", ""));
  EXPECT_EQ(data_file(), folder_.file("there.vtu"));
  state.set(SmallState::source, "FileName", {"C:\\data\\there.vtu"});
  EXPECT_EQ(data_file(), folder_.file("there.vtu"));
  std::filesystem::create_directory(folder_.file("sub"));
  static_cast<void>(folder_.write("sub/there.vtu", ""));
  state.set(SmallState::source, "FileName", {folder_.file("sub/there.vtu")});
  EXPECT_EQ(data_file(), folder_.file("sub/there.vtu"));
  state.without(SmallState::source, "FileName");
  EXPECT_EQ(data_file(), "");
  state.set(SmallState::source, "FileNames", {"many.exo"});
  EXPECT_EQ(data_file(), "many.exo");
}

TEST_F(SmallSurfaces, OpacityBendsAtItsMidpointAndStepsWhereItIsSharp) {
  const auto extinction = [&](const SmallState::Values& points) {
    return surface_scene(SmallState().set(SmallState::opacities, "Points", points))
        .volume.extinction->function();
  };
  const auto bent = extinction({"0", "0", "0.25", "0", "2", "1", "0.5", "0"});
  EXPECT_NEAR(bent(0.5)[0], 0.5, 1e-9);
  EXPECT_NEAR(bent(0.25)[0], 0.25, 1e-9);
  EXPECT_NEAR(bent(1.25)[0], 0.75, 1e-9);
  const auto step = extinction({"0", "0.25", "0.75", "1", "2", "1", "0.5", "0"});
  EXPECT_EQ(step(1.49)[0], 0.25);
  EXPECT_EQ(step(1.51)[0], 1);
  const auto nearly = extinction({"0", "0.25", "0.75", "0.99", "2", "1", "0.5", "0"});
  EXPECT_NEAR(nearly(1.5)[0], 0.625, 1e-4);  // a curve, not a step
  EXPECT_LT(nearly(1.4)[0], 0.5);
  const auto jump = extinction(
      {"0", "0", "0.5", "0", "1", "0.5", "0.5", "0", "1", "1", "0.5", "0", "2", "0", "0.5", "0"});
  EXPECT_NEAR(jump(0.999)[0], 0.4995, 1e-9);
  EXPECT_NEAR(jump(1.001)[0], 0.999, 1e-9);
}

TEST_F(SmallSurfaces, ViewsAreChosenByName) {
  const std::string path = folder_.write("a.pvsm", SmallState().text());
  EXPECT_THAT(view_from_state(path + "#RenderView").notes, Contains("view: RenderView"));
  try {
    static_cast<void>(view_from_state(path + "#Other"));
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_EQ(error.what(),
              path + ": no render view of the name Other (expected one of RenderView)");
  }
  EXPECT_EQ(paraview_file_of(path + "#Other"), path);
  EXPECT_TRUE(is_paraview_file("a.pvsm"));
  EXPECT_TRUE(is_paraview_file("a.pvcc"));
  EXPECT_TRUE(is_paraview_file("a.pvsm#view"));
  EXPECT_FALSE(is_paraview_file("a.toml"));
  EXPECT_FALSE(is_paraview_file("a.toml#view"));
}

// The table itself is VTK's; it turns evenly from blue over white to orange.
TEST_F(SmallSurfaces, WarmthsOfLightsHaveEvenColours) {
  SmallState state;
  state.set(SmallState::shown, "Representation", {"Surface"});
  state.set(SmallState::view, "UseLight", {"1"});
  state.set(SmallState::view, "KeyLightIntensity", {"1"});
  std::vector<Color> colors;
  for (int k = 0; k <= 63; ++k) {
    state.set(SmallState::view, "KeyLightWarmth", {fmt::format("{}", k / 63.0)});
    colors.push_back(surface_scene(state).lights[0].color);
  }
  for (std::size_t k = 0; k < colors.size(); ++k)
    for (const double channel : colors[k]) EXPECT_TRUE(0 <= channel && channel <= 1) << k;
  for (std::size_t k = 1; k < 32; ++k) {
    EXPECT_GE(colors[k][0], colors[k - 1][0]) << k;
    EXPECT_GE(colors[k][1], colors[k - 1][1]) << k;
    EXPECT_EQ(colors[k][2], 1) << k;
  }
  for (std::size_t k = 33; k < 64; ++k) {
    EXPECT_EQ(colors[k][0], 1) << k;
    EXPECT_LE(colors[k][1], colors[k - 1][1]) << k;
    EXPECT_LE(colors[k][2], colors[k - 1][2]) << k;
  }
  for (std::size_t k = 1; k + 1 < colors.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) {
      const double bend = colors[k - 1][c] - 2 * colors[k][c] + colors[k + 1][c];
      const bool ends = c == 2 && (k == 51 || k == 52);  // there is no blue in warmer light
      EXPECT_LT(std::abs(bend), ends ? 0.07 : 0.006) << k << " " << c;
    }
}

}  // namespace
}  // namespace hiac::test
