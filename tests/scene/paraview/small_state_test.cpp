// States of ParaView made by hand: what is taken of unusual ones, and what is said of those that
// have no equal here.
#include "tests/scene/paraview/small_state.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/paraview/paraview_view.hpp"
#include "hiac/scene/specification.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

struct Change {
  int id;
  const char* property;
  SmallState::Values values;
  const char* message;  ///< behind the proxy and the property; empty: none
};

std::string proxy_name(int id) {
  constexpr const char* kTypes[] = {"",
                                    "XMLUnstructuredGridReader",
                                    "RenderView",
                                    "UnstructuredGridRepresentation",
                                    "PVLookupTable",
                                    "PiecewiseFunction"};
  return std::string(kTypes[id]) + " " + std::to_string(id);
}

class SmallStates : public testing::Test {
 protected:
  ParaviewView small_view(const SmallState& state) {
    return view_from_state(folder_.write("a.pvsm", state.text()));
  }
  Scene small_scene(const SmallState& state) {
    return parse_scene(small_view(state).text, "spec").scene;
  }
  /// The message without the file's name; empty for none.
  std::string told_of_text(const std::string& text) {
    const std::string path = folder_.write("a.pvsm", text);
    try {
      static_cast<void>(view_from_state(path));
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with(path + ": ")) << message;
      return message.substr(path.size() + 2);
    }
    return "";
  }
  std::string told_of(const SmallState& state) { return told_of_text(state.text()); }

  void expect_told(const std::vector<Change>& changes) {
    for (const Change& c : changes)
      EXPECT_EQ(told_of(SmallState().set(c.id, c.property, c.values)),
                *c.message == '\0' ? "" : proxy_name(c.id) + ": " + c.property + ": " + c.message)
          << c.property;
  }

  ScratchFolder folder_;
};

TEST_F(SmallStates, ShowAVolumeWithItsFunctions) {
  const Scene scene = small_scene(SmallState());
  EXPECT_EQ(scene.image, (ImageSize{40, 30}));
  EXPECT_EQ(scene.camera.fov, 30);
  EXPECT_EQ(scene.volume.color->field, "t@node:value");
  EXPECT_EQ(scene.volume.color->function()(2)[1], 1);
  EXPECT_EQ(scene.volume.extinction->function()(1)[0], 0.5);
  EXPECT_EQ(small_view(SmallState()).data_file, "none.vtu");
}

TEST_F(SmallStates, ColourFunctionsAreRefusedByProperty) {
  using S = SmallState;
  expect_told({
      {S::colors, "IndexedLookup", {"1"}, "colours of categories have no equal here"},
      {S::colors, "IndexedLookup", {"0"}, ""},
      {S::colors,
       "Use2DTransferFunction",
       {"1"},
       "a transfer function of two scalars has no equal here"},
      {S::colors, "ColorSpace", {"6"}, "expected 0 to 5, found 6"},
      {S::colors, "ColorSpace", {"-1"}, "expected 0 to 5, found -1"},
      {S::colors, "ColorSpace", {"0.5"}, "expected 0 to 5, found 0.5"},
      {S::colors, "ColorSpace", {"5"}, ""},
      {S::colors,
       "RGBPoints",
       {"0", "0", "0"},
       "expected scalar, red, green and blue for every point, found 3 numbers"},
      {S::colors,
       "RGBPoints",
       {},
       "expected scalar, red, green and blue for every point, found 0 numbers"},
      {S::colors, "RGBPoints", {"0", "0", "0", "1.5"}, "a colour is 0 to 1, found 1.5"},
      {S::colors, "RGBPoints", {"0", "-1", "0", "0"}, "a colour is 0 to 1, found -1"},
      {S::colors,
       "RGBPoints",
       {"-1e308", "0", "0", "0", "1e308", "1", "1", "1"},
       "the scalars' range is not finite"},
      {S::colors, "RGBPoints", {"0", "x", "0", "0"}, "expected a finite number, found \"x\""},
      {S::colors, "RGBPoints", {"inf"}, "expected a finite number, found \"inf\""},
      {S::colors, "RGBPoints", {"1 "}, "expected a finite number, found \"1 \""},
      {S::colors, "VectorMode", {"2"}, "colours that are the data have no equal here"},
  });
  const std::string long_text(41, '1');
  EXPECT_EQ(told_of(SmallState().set(S::colors, "RGBPoints", {"x" + long_text})),
            "PVLookupTable 4: RGBPoints: expected a finite number, found \"x" +
                long_text.substr(0, 39) + "\"");
}

TEST_F(SmallStates, OpacitiesAndPicturesAreRefusedByProperty) {
  using S = SmallState;
  expect_told({
      {S::opacities,
       "Points",
       {"0", "1"},
       "expected scalar, opacity, midpoint and sharpness for every point, found 2 numbers"},
      {S::opacities,
       "Points",
       {"0", "1", "1", "1.25"},
       "opacity, midpoint and sharpness are 0 to 1, found 1.25"},
      {S::opacities,
       "Points",
       {"0", "-1", "1", "1"},
       "opacity, midpoint and sharpness are 0 to 1, found -1"},
      {S::opacities,
       "Points",
       {"-1e308", "0", "0.5", "0", "1e308", "0", "0.5", "0"},
       "the scalars' range is not finite"},
      {S::view, "ViewSize", {"0", "1"}, "expected 1 to 65536 pixels, found 0"},
      {S::view, "ViewSize", {"1", "65537"}, "expected 1 to 65536 pixels, found 65537"},
      {S::view, "ViewSize", {"1.5", "1"}, "expected 1 to 65536 pixels, found 1.5"},
      {S::view, "ViewSize", {"1"}, "expected 2 numbers, found 1"},
      {S::view, "ViewSize", {"1", "65536"}, ""},
      {S::view, "Background", {"0", "0", "1.5"}, "a colour is 0 to 1, found 1.5"},
      {S::view, "CameraPosition", {"0", "0", "1", "2"}, "expected 3 numbers, found 4"},
  });
}

TEST_F(SmallStates, RepresentationsAreRefusedByProperty) {
  using S = SmallState;
  expect_told({
      {S::shown, "MapScalars", {"0"}, "colours that are the data have no equal here"},
      {S::shown, "MapScalars", {"1"}, ""},
      {S::shown,
       "MultiComponentsMapping",
       {"1"},
       "opacity of a second component has no equal here"},
      {S::shown, "SelectMapper", {"GPU"}, "not known what opacity means to the mapper \"GPU\""},
      {S::shown, "ColorArrayName", {"", "", "", "0", ""}, "names no array"},
      {S::shown, "ColorArrayName", {"", "", "", "0"}, "names no array"},
      {S::shown, "ColorArrayName", {"", "", "", "1", "t"}, ""},
      {S::shown,
       "ColorArrayName",
       {"", "", "", "2", "t"},
       "an array of points (0) or cells (1) is expected, found one of 2"},
      {S::shown, "ScalarOpacityUnitDistance", {"0"}, "expected a positive number"},
      {S::shown, "LookupTable", {}, "refers to nothing in the file"},
      {S::shown, "LookupTable", {"@77"}, "refers to nothing in the file"},
      {S::shown, "ScalarOpacityFunction", {}, "refers to nothing in the file"},
  });
}

TEST_F(SmallStates, WhoseDataAreMovedAreRefused) {
  const char* moved = "data that are moved, turned or scaled have no equal here";
  SmallState::Values unit(16, "0");
  for (const std::size_t i : {0u, 5u, 10u, 15u}) unit[i] = "1";
  SmallState::Values mirrored = unit;
  mirrored[15] = "-1";
  const char* blocks = "some blocks alone have no equal here (all expected)";
  const int id = SmallState::shown;
  expect_told({
      {id, "Position", {"0", "0", "0"}, ""},
      {id, "Position", {}, ""},
      {id, "Position", {"0", "0", "1"}, moved},
      {id, "Orientation", {"0", "0", "0"}, ""},
      {id, "Orientation", {"90", "0", "0"}, moved},
      {id, "Scale", {"1", "1", "1"}, ""},
      {id, "Scale", {"1", "1", "2"}, moved},
      {id, "Scale", {"0", "0", "0"}, moved},
      {id, "UserTransform", unit, ""},
      {id, "UserTransform", mirrored, moved},
      {id, "BlockSelectors", {"/"}, ""},
      {id, "BlockSelectors", {"/Root", "/"}, ""},
      {id, "BlockSelectors", {"/", "/Root/a"}, blocks},
  });
}

TEST_F(SmallStates, ThatAreNoneAreRefused) {
  EXPECT_EQ(told_of_text("<ServerManagerState>"), "malformed XML (Start-end tags mismatch)");
  EXPECT_EQ(told_of_text("<" + std::string(50, 'a') + "/>"),
            "is XML, but no state or camera of ParaView (expected <ServerManagerState> or "
            "<PVCameraConfiguration>, found <" +
                std::string(40, 'a') + ">)");
  EXPECT_EQ(told_of_text("<PVCameraConfiguration/>"),
            "is a camera file of ParaView without a camera");
  EXPECT_EQ(told_of_text("<ParaView><ServerManagerState/></ParaView>"), "holds no render view");
}

TEST_F(SmallStates, ShowOneVolume) {
  SmallState state;
  state.add(6, "sources", "ExodusIIReader", {});
  state.add(7, "representations", "UnstructuredGridRepresentation",
            {{"Input", {"@6"}}, {"Representation", {"Volume"}}});
  state.set(SmallState::view, "Representations", {"@3", "@7"});
  EXPECT_EQ(told_of(state),
            "the view shows two volumes, of XMLUnstructuredGridReader and of ExodusIIReader (one "
            "is expected: hide the other and save the state again)");
  EXPECT_EQ(told_of(state.set(7, "Visibility", {"0"})), "");
  EXPECT_EQ(told_of(state.set(7, "Visibility", {"1"}).set(7, "Representation", {"Surface"})), "");
  EXPECT_THAT(small_view(state).omitted,
              ElementsAre("ExodusIIReader (ExodusIIReader) as Surface: has no equal here and is "
                          "not drawn"));
  EXPECT_THAT(small_view(state.without(7, "Input")).omitted,
              ElementsAre("UnstructuredGridRepresentation: shows no data of the pipeline"));
  EXPECT_EQ(told_of(SmallState().set(SmallState::shown, "Representation", {"Outline"})),
            "nothing that the view RenderView shows can be drawn (a volume, a surface or contours "
            "of a file expected)");
}

TEST_F(SmallStates, HaveLawsByTheirMappers) {
  const auto extinction_of_half = [&](const SmallState::Values& mapper) {
    return small_scene(SmallState()
                           .set(SmallState::shown, "SelectMapper", mapper)
                           .set(SmallState::shown, "ScalarOpacityUnitDistance", {"2"}))
        .volume.extinction->function()(1)[0];
  };
  for (const char* mapper : {"Projected tetra", "Z sweep", "Bunyk ray cast"})
    EXPECT_DOUBLE_EQ(extinction_of_half({mapper}), 0.25) << mapper;
  EXPECT_NEAR(extinction_of_half({"Resample To Image"}), std::log(2) / 2, 1e-3);
  EXPECT_NEAR(extinction_of_half({}), std::log(2) / 2, 1e-3);
}

TEST_F(SmallStates, HaveStepsOfTablesWithProjectedTetrahedraAlone) {
  SmallState state;
  state.set(SmallState::colors, "Discretize", {"1"});
  state.set(SmallState::colors, "NumberOfTableValues", {"2"});
  EXPECT_THAT(small_view(state).notes, Contains(HasSubstr("by RGB in 2 steps, error")));
  EXPECT_EQ(small_scene(state).volume.color->function()(0.99)[0], 0);
  EXPECT_EQ(small_scene(state).volume.color->function()(1.01)[0], 1);
  state.set(SmallState::colors, "NumberOfTableValues", {"1"});  // one step has the middle's colour
  const double middle = small_scene(state).volume.color->function()(0.1)[0];
  EXPECT_EQ(middle, small_scene(state).volume.color->function()(1.9)[0]);
  EXPECT_NEAR(middle, 0.214, 0.001);  // display value one half
  state.set(SmallState::shown, "SelectMapper", {"Z sweep"});
  EXPECT_THAT(small_view(state).notes, Contains(HasSubstr("by RGB, error")));
  state.set(SmallState::shown, "SelectMapper", {"Projected tetra"});
  const auto with_count = [&](const char* count) {
    return told_of(state.set(SmallState::colors, "NumberOfTableValues", {count}));
  };
  const std::string before = "PVLookupTable 4: NumberOfTableValues: expected 1 to 65536, found ";
  EXPECT_EQ(with_count("0"), before + "0");
  EXPECT_EQ(with_count("65537"), before + "65537");
  EXPECT_EQ(with_count("65536"), "");
}

TEST_F(SmallStates, HaveColoursOutsideTheRange) {
  SmallState state;
  state.set(SmallState::colors, "UseBelowRangeColor", {"1"});
  state.set(SmallState::colors, "BelowRangeColor", {"1", "0", "0"});
  state.set(SmallState::colors, "UseAboveRangeColor", {"1"});
  state.set(SmallState::colors, "AboveRangeColor", {"0", "0", "1"});
  const auto color = small_scene(state).volume.color->function();
  EXPECT_EQ(color(-1), (std::array<double, 3>{1, 0, 0}));
  EXPECT_EQ(color(2), (std::array<double, 3>{0, 0, 1}));
  EXPECT_EQ(color(1.999)[0], color(1.999)[2]);
}

TEST_F(SmallStates, LookUpComponentsAndOtherArrays) {
  SmallState state;
  state.set(SmallState::colors, "VectorMode", {"1"});
  EXPECT_EQ(small_scene(state).volume.color->field, "t@node:0");
  state.set(SmallState::colors, "VectorComponent", {"2"});
  EXPECT_EQ(small_scene(state).volume.color->field, "t@node:2");
  state.set(SmallState::shown, "UseSeparateOpacityArray", {"1"});
  state.set(SmallState::shown, "OpacityArrayName", {"", "", "", "1", "p"});
  state.set(SmallState::shown, "OpacityComponent", {"1"});
  EXPECT_EQ(small_scene(state).volume.color->field, "t@node:2");
  EXPECT_EQ(small_scene(state).volume.extinction->field, "p@cell:1");
}

TEST_F(SmallStates, HaveParallelCamerasByTwoSwitches) {
  for (const char* property : {"CameraParallelProjection", "InteractionMode"}) {
    SmallState state;
    state.set(SmallState::view, property, {"1"});
    EXPECT_EQ(told_of(state), "RenderView 2: CameraParallelScale: expected a positive number");
    state.set(SmallState::view, "CameraParallelScale", {"1.5"});
    EXPECT_EQ(small_scene(state).camera.height, 3);
  }
  EXPECT_EQ(
      small_scene(SmallState().set(SmallState::view, "InteractionMode", {"2"})).camera.projection,
      Projection::perspective);
}

TEST_F(SmallStates, HaveBackgroundsByTheirMode) {
  SmallState state;
  state.set(SmallState::view, "Background", {"1", "0", "0"});
  state.set(SmallState::view, "Background2", {"0", "0", "1"});
  EXPECT_EQ(small_scene(state).background.pattern, BackgroundPattern::solid);
  EXPECT_EQ(small_scene(state).background.color, (Color{1, 0, 0}));
  state.set(SmallState::view, "UseGradientBackground", {"1"});  // before ParaView 5.10
  EXPECT_EQ(small_scene(state).background,
            (Background{BackgroundPattern::gradient, {0, 0, 1}, {1, 0, 0}, 32}));
  state.set(SmallState::view, "BackgroundColorMode", {"2"});
  EXPECT_EQ(small_scene(state).background.pattern, BackgroundPattern::solid);
  EXPECT_THAT(small_view(state).omitted,
              ElementsAre("the background's picture: has no equal here, its colour is drawn"));
  state.set(SmallState::view, "UseColorPaletteForBackground", {"1"});
  state.set(SmallState::view, "BackgroundColorMode", {"0"});
  EXPECT_NEAR(small_scene(state).background.color[2], 0.155, 0.001);  // ParaView's, 0.43
  state.add(6, "settings", "ColorPalette", {{"BackgroundColor", {"0", "1", "0"}}});
  EXPECT_EQ(small_scene(state).background.color, (Color{0, 1, 0}));
}

TEST_F(SmallStates, HaveRatiosOfLightsAbove0) {
  SmallState state;
  state.set(SmallState::shown, "Representation", {"Surface"});
  state.set(SmallState::view, "UseLight", {"1"});
  EXPECT_EQ(small_scene(state).lights.size(), 5U);
  const auto with = [&](const char* property, const char* value) {
    SmallState changed = state;
    return told_of(changed.set(SmallState::view, property, {value}));
  };
  EXPECT_EQ(with("FillLightK:F Ratio", "0"),
            "RenderView 2: FillLightK:F Ratio: expected more than 0, found 0");
  EXPECT_EQ(with("HeadLightK:H Ratio", "-1"),
            "RenderView 2: HeadLightK:H Ratio: expected more than 0, found -1");
  EXPECT_EQ(with("KeyLightWarmth", "-0.5"),
            "RenderView 2: KeyLightWarmth: expected 0 to 1, found -0.5");
  EXPECT_EQ(with("KeyLightWarmth", "1"), "");
  EXPECT_EQ(with("KeyLightIntensity", "2e30"),
            "RenderView 2: KeyLightIntensity: expected 0 to 1e+30, found 2e+30");
  EXPECT_EQ(with("KeyLightIntensity", "0"), "");
}

TEST_F(SmallStates, HaveLogarithmicScalesOfPositiveScalars) {
  SmallState state;
  state.set(SmallState::colors, "UseLogScale", {"1"});
  state.set(SmallState::colors, "RGBPoints", {"1", "0", "0", "0", "100", "1", "1", "1"});
  EXPECT_THAT(small_view(state).notes, Contains(HasSubstr("by RGB, logarithmic, error")));
  EXPECT_NEAR(small_scene(state).volume.color->function()(10)[0], 0.214, 0.001);
  state.set(SmallState::colors, "RGBPoints", {"0", "0", "0", "0", "100", "1", "1", "1"});
  EXPECT_THAT(small_view(state).notes, Contains(HasSubstr("by RGB, error")));
  state.set(SmallState::colors, "RGBPoints", {"-2", "0", "0", "0", "-1", "1", "1", "1"});
  EXPECT_EQ(told_of(state),
            "PVLookupTable 4: UseLogScale: a logarithmic scale of negative scalars "
            "is not read here");
}

}  // namespace
}  // namespace hiac::test
