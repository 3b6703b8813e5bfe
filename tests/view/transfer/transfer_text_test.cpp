#include "tools/view/transfer/transfer_text.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/specification.hpp"
#include "tools/view/transfer/saved_curves.hpp"

namespace hiac::view {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kHead =
    "[image]  # small\nwidth = 4\nheight = 3\n[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\n"
    "up = [0, 1, 0]\nfov = 20\n";
const std::string kColor =
    "\n[volume.color]\nfield = \"p\"\npreset = \"viridis\"  # mine\n"
    "range = [0.0, 4.0]\n";
const std::string kExtinction =
    "\n[volume.extinction]\nfield = \"p\"\npoints = [\n  [0, 0.5],  # low\n  [2, 1.0],\n"
    "  [4, 8.0],  # high\n]\n";
const std::string kText = kHead + kColor + kExtinction;

Scene scene_of(const std::string& text) { return parse_scene(text, "view").scene; }

std::vector<std::array<double, 2>> rows(const std::string& text) {
  std::vector<std::array<double, 2>> all;
  const Scene scene = scene_of(text);
  for (const auto& point : scene.volume.extinction->points)
    all.push_back({point.scalar, point.value[0]});
  return all;
}

using Rows = std::vector<std::array<double, 2>>;

TEST(TransferText, EditsPointsWhereTheyStand) {
  const Scene scene = scene_of(kText);
  const std::string moved = with_point<1>(kText, scene, 1, {2.5, {0}});
  EXPECT_EQ(rows(moved), (Rows{{0, 0.5}, {2.5, 0}, {4, 8}}));
  EXPECT_EQ(with_point<1>(moved, scene_of(moved), 1, {2, {1}}),
            kHead + kColor +
                "\n[volume.extinction]\nfield = \"p\"\npoints = [\n  [0, 0.5],  # low\n"
                "  [2.0, 1.0],\n  [4, 8.0],  # high\n]\n");
  EXPECT_EQ(rows(with_new_point<1>(kText, scene, {2, {7}})),
            (Rows{{0, 0.5}, {2, 1}, {2, 7}, {4, 8}}));
  EXPECT_EQ(rows(with_new_point<1>(kText, scene, {9, {7}})),
            (Rows{{0, 0.5}, {2, 1}, {4, 8}, {9, 7}}));
  const std::string removed = without_point<1>(kText, scene, 2);
  EXPECT_EQ(rows(removed), (Rows{{0, 0.5}, {2, 1}}));
  EXPECT_THAT(removed, HasSubstr("# low"));
}

TEST(TransferText, MakesPointsPlainWithoutAChangeOfTheScene) {
  EXPECT_FALSE(has_plain_points<3>(kText));
  EXPECT_TRUE(has_plain_points<1>(kText));
  const std::string plain = with_plain_points<3>(kText, scene_of(kText));
  EXPECT_TRUE(has_plain_points<3>(plain));
  EXPECT_EQ(scene_of(plain), scene_of(kText));
  EXPECT_THAT(plain, Not(HasSubstr("preset")));
  std::string log = kHead +
                    "\n[volume.extinction]\nfield = \"p\"\nrange = [1, 100]\n"
                    "scale = \"log\"\npoints = [[0, 1], [1, 3]]\n";
  EXPECT_EQ(scene_of(with_plain_points<1>(log, scene_of(log))), scene_of(log));
  const std::string display = kHead +
                              "\n[volume.color]\nfield = \"p\"\nscale = \"log\"\n"
                              "color_space = \"srgb\"\npoints = [[1, 0, 0, 0], [100, 1, 1, 1]]\n";
  const Scene shown = scene_of(display);
  EXPECT_EQ(scene_of(with_plain_points<3>(display, shown)).volume, shown.volume);
  // the strip below the curve: half grey on a display in the geometric middle
  EXPECT_NEAR(shown.volume.color->function()(10)[0], 0.21404114, 2e-3);
}

TEST(TransferText, ScalesEveryExtinctionWhateverItsRange) {
  EXPECT_EQ(rows(with_density(kText, 4)), (Rows{{0, 2}, {2, 4}, {4, 32}}));
  const std::string ranged = kHead +
                             "[volume.extinction]\nfield = \"p\"\nrange = [10, 20]\n"
                             "points = [[0, 0], [1, 3.5]]\n";
  EXPECT_EQ(rows(with_density(ranged, 2)), (Rows{{10, 0}, {20, 7}}));
  EXPECT_THAT(with_density(ranged, 2), HasSubstr("range = [10, 20]"));
}

TEST(TransferText, PutsABumpOnTheCurve) {
  const std::string text = with_bump(kText, scene_of(kText), 3, 0.25, 20);
  EXPECT_EQ(rows(text), (Rows{{0, 0.5}, {2, 1}, {2.75, 3.625}, {3, 20}, {3.25, 5.375}, {4, 8}}));
  EXPECT_THAT(text, HasSubstr("# low"));
  // one that swallows points, also all of them
  EXPECT_EQ(rows(with_bump(kText, scene_of(kText), 2, 0.5, 20)),
            (Rows{{0, 0.5}, {1.5, 0.875}, {2, 20}, {2.5, 2.75}, {4, 8}}));
  EXPECT_EQ(rows(with_bump(kText, scene_of(kText), 2, 3, 20)), (Rows{{-1, 0.5}, {2, 20}, {5, 8}}));
  // never lower than the curve is
  EXPECT_EQ(rows(with_bump(kText, scene_of(kText), 2, 0.5, 0))[2], (std::array<double, 2>{2, 1}));
}

TEST(TransferText, MakesBumpsHighEnough) {
  EXPECT_EQ(bump_peak({{0, {1}}, {1, {2}}, {2, {3}}}, 9), 10);
  EXPECT_EQ(bump_peak({{0, {1}}, {1, {2}}, {2, {30}}}, 9), 30);
  EXPECT_EQ(bump_peak({{0, {0}}}, 9), 9);
}

TEST(TransferText, ChangesColourMaps) {
  const std::string other = with_preset(kText, scene_of(kText), "magma", "q", {7, 8});
  EXPECT_EQ(preset_of(other), "magma");
  EXPECT_THAT(other, HasSubstr("preset = \"magma\"  # mine\nrange = [0.0, 4.0]"));
  // points give their span
  const std::string points = kHead +
                             "[volume.color]\nfield = \"p\"\n"
                             "points = [[1, 0, 0, 0], [3, 1, 1, 1]]\n";
  const std::string mapped = with_preset(points, scene_of(points), "magma", "q", {7, 8});
  EXPECT_EQ(scene_of(mapped).volume.color->points.front().scalar, 1);
  EXPECT_EQ(scene_of(mapped).volume.color->points.back().scalar, 3);
  const std::string first = with_preset(kHead, scene_of(kHead), "magma", "q", {7, 8});
  EXPECT_EQ(scene_of(first).volume.color->field, "q");
  EXPECT_EQ(scene_of(first).volume.color->points.back().scalar, 8);
  const std::string ranged = with_color_range(kText, {1, 2});
  EXPECT_EQ(scene_of(ranged).volume.color->points.front().scalar, 1);
}

TEST(TransferText, StretchesAFunctionOntoAnotherField) {
  const std::string text = with_field<1>(kText, scene_of(kText), "q", {100, 300});
  EXPECT_EQ(scene_of(text).volume.extinction->field, "q");
  EXPECT_EQ(rows(text), (Rows{{100, 0.5}, {200, 1}, {300, 8}}));
  const Scene colored = scene_of(with_field<3>(kText, scene_of(kText), "q", {100, 300}));
  EXPECT_EQ(colored.volume.color->points.front().scalar, 100);
  EXPECT_EQ(colored.volume.color->points.back().scalar, 300);
}

TEST(TransferText, AddsEditsAndRemovesIsosurfaces) {
  Isosurface surface;
  surface.field = "p";
  surface.value = 1.5;
  surface.opacity = 0.25;
  std::string text = with_surface(kText, scene_of(kText), surface);
  surface.value = 3;
  text = with_surface(text, scene_of(text), surface);
  text = with_surface_opacity(text, 0, 0.75);
  text = with_surface_color(text, 1, {1, 0, 0.5});
  text = with_surface_value(text, 1, 3.5);
  const Scene scene = scene_of(text);
  ASSERT_EQ(scene.isosurfaces.size(), 2U);
  EXPECT_EQ(scene.isosurfaces[0].opacity, 0.75);
  EXPECT_EQ(scene.isosurfaces[1].color, (Color{1, 0, 0.5}));
  EXPECT_EQ(scene.isosurfaces[1].value, 3.5);
  text = without_surface(text, 0);
  EXPECT_EQ(scene_of(text).isosurfaces.size(), 1U);
  EXPECT_EQ(scene_of(text).isosurfaces[0].value, 3.5);
  EXPECT_EQ(scene_of(without_surface(text, 0)), scene_of(kText));
}

TEST(SavedCurves, GiveTheSameFunctionsInAnotherView) {
  const std::string saved = saved_curves(kText, scene_of(kText));
  EXPECT_THAT(saved, HasSubstr("preset = \"viridis\""));
  for (const std::string& other :
       {kHead, kHead + "[volume.color]\nfield = \"x\"\npreset = \"magma\"\nrange = [0, 1]\n"}) {
    const std::string text = with_saved_curves(other, saved, "saved.toml");
    EXPECT_EQ(scene_of(text).volume, scene_of(kText).volume);
    EXPECT_TRUE(text.starts_with(kHead));
  }
  // half a file leaves the other half
  const std::string half = with_saved_curves(kText,
                                             "[volume.extinction]\nfield = \"q\"\n"
                                             "points = [[1, 2]]\n",
                                             "saved.toml");
  EXPECT_EQ(scene_of(half).volume.color, scene_of(kText).volume.color);
  EXPECT_EQ(rows(half), (Rows{{1, 2}}));
  // in braces, too
  EXPECT_EQ(rows(with_saved_curves(
                kText, "volume.extinction = {field = \"q\", points = [[1, 2]]}\n", "saved.toml")),
            (Rows{{1, 2}}));
}

TEST(SavedCurves, RefuseFilesWithoutAny) {
  const auto told = [](const auto& work) -> std::string {
    try {
      work();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const auto told_of = [&](const std::string& saved) {
    return told([&] { static_cast<void>(with_saved_curves(kText, saved, "saved.toml")); });
  };
  const std::string none =
      "saved.toml: no transfer functions (expected [volume.color] or [volume.extinction], found "
      "neither)";
  EXPECT_EQ(told_of("[image]\nwidth = 3\n"), none);
  EXPECT_EQ(told_of("[volume.color]\n"), none);
  EXPECT_EQ(told_of("[volume.color]\nfield = \"q\"\n"), "");
  EXPECT_THAT(told_of("[image\n"), testing::StartsWith("saved.toml:1: "));
  EXPECT_EQ(told([] { static_cast<void>(saved_curves(kHead, scene_of(kHead))); }),
            "transfer functions: the view has none");
}

}  // namespace
}  // namespace hiac::view
