// The table and the facts of one pixel, from numbers that are known.
#include "tools/common/picture/pixel_report.hpp"

#include <string>

#include <gtest/gtest.h>

namespace hiac::tools {
namespace {

using PixelJson = nlohmann::ordered_json;

/// A scene with two fields and an isosurface.
Scene two_fields() {
  Scene scene;
  scene.volume.color = ColorTransfer{"c", {{0, {1, 1, 1}}}};
  scene.volume.extinction = ExtinctionTransfer{"e", {{0, {1}}}};
  scene.isosurfaces.resize(2);
  scene.isosurfaces[1].field = "s";
  scene.isosurfaces[1].value = 0.75;
  return scene;
}

PixelSegment segment() {
  PixelSegment s;
  s.cell = 17;
  s.kind = CellKind::brick8;
  s.front = {1.5, 0.25, 2, {0.1, 0.2, 0.3}, 4};
  s.back = {2.5, 0.125, 3, {0.4, 0.5, 0.6}, 8};
  s.length = 1.25;
  s.psi = 0.875;
  s.surfaces = {{1, 1.75, {0.01, 0.02, 0.03}, 0.5}};
  s.transparency = 0.0625;
  s.color = {0.7, 0.8, 0.9};
  s.error = 1.5e-11;
  return s;
}

/// A segment between skin and an edge on no cell.
PixelExplanation some_pixel() {
  PixelExplanation pixel;
  pixel.x = 21;
  pixel.y = 14;
  PixelSegment skin;
  skin.part = RayPart::skin;
  skin.cell = 3;
  skin.front.depth = 1.25;
  skin.light = {0.5, 0.25, 0.125};
  skin.opacity = 0.75;
  skin.transparency = 0.25;
  skin.color = {0.11, 0.12, 0.13};
  PixelSegment edge = skin;
  edge.part = RayPart::edge;
  edge.cell = kNoCell;
  edge.in_group = true;
  pixel.segments = {skin, segment(), edge};
  pixel.transparency = 0.03125;
  pixel.background = {0.5, 1, 0};
  pixel.rgba = {0.1, 0.2, 0.3, 0.5};
  return pixel;
}

const std::string kEnd =
    "background 0.5 1 0 seen through 0.03125\n"
    "pixel 21,14: R 0.10000000000000001 G 0.20000000000000001 B 0.29999999999999999 A 0.5\n";

TEST(PixelReport, EveryFieldHasItsColumn) {
  EXPECT_EQ(
      pixel_table(some_pixel(), two_fields()),
      "   cell        kind  depth  e  tau      c  kappa R    G    B    Psi  transparency     R"
      "     G     B    error\n"
      "1     3        skin   1.25                                                   0.25  0.11"
      "  0.12  0.13  opacity 0.75, color 0.5 0.25 0.125\n"
      "2    17      brick8    1.5  2    4   0.25      0.1  0.2  0.3\n"
      "         isosurface   1.75  s = 0.75, opacity 0.5, color 0.01 0.02 0.03\n"
      "                       2.5  3    8  0.125      0.4  0.5  0.6  0.875        0.0625   0.7"
      "   0.8   0.9  1.5e-11\n"
      "3              edge   1.25                                                   0.25  0.11"
      "  0.12  0.13  opacity 0.75, color 0.5 0.25 0.125\n" +
          kEnd);
}

TEST(PixelReport, ColumnsThatSayNothingNewAreLeftOut) {
  PixelExplanation pixel = some_pixel();
  pixel.segments = {segment()};
  pixel.segments[0].surfaces.clear();
  pixel.segments[0].error.reset();
  Scene same = two_fields();
  same.volume.color->field = "e";
  EXPECT_EQ(
      pixel_table(pixel, same),
      "   cell    kind  depth  e  tau  kappa R    G    B    Psi  transparency    R    G    B  "
      "error\n"
      "1    17  brick8    1.5  2    4      0.1  0.2  0.3\n"
      "                   2.5  3    8      0.4  0.5  0.6  0.875        0.0625  0.7  0.8  0.9  "
      "     \n" +
          kEnd);
  Scene dark = two_fields();
  dark.volume.color.reset();
  EXPECT_EQ(pixel_table(pixel, dark),
            "   cell    kind  depth  e  tau    Psi  transparency    R    G    B  error\n"
            "1    17  brick8    1.5  2    4\n"
            "                   2.5  3    8  0.875        0.0625  0.7  0.8  0.9       \n" +
                kEnd);
  Scene clear = two_fields();
  clear.volume.extinction.reset();
  EXPECT_EQ(pixel_table(pixel, clear),
            "   cell    kind  depth      c  kappa R    G    B    Psi  transparency    R    G    B  "
            "error\n"
            "1    17  brick8    1.5   0.25      0.1  0.2  0.3\n"
            "                   2.5  0.125      0.4  0.5  0.6  0.875        0.0625  0.7  0.8  0.9  "
            "     \n" +
                kEnd);
}

TEST(PixelReport, RemarksStandBehindTheLines) {
  PixelExplanation pixel = some_pixel();
  pixel.segments.clear();
  EXPECT_EQ(pixel_table(pixel, two_fields()), kEnd);
  pixel.ended = true;
  pixel.error = 2.5e-10;
  EXPECT_EQ(pixel_table(pixel, two_fields()),
            "the ray ends here: cells behind would change the pixel by less than "
            "render.tolerance\n" +
                std::string(kEnd).insert(kEnd.find("pixel"), "error at most 2.5e-10\n"));
  const auto remark = [&](bool in_group, bool out_of_order) {
    pixel.segments = {segment()};
    pixel.segments[0].in_group = in_group;
    pixel.segments[0].out_of_order = out_of_order;
    const std::string table = pixel_table(pixel, two_fields());
    const std::size_t number = table.find("1.5e-11") + 7;
    return table.substr(number, table.find('\n', number) - number);
  };
  EXPECT_EQ(remark(false, false), "");
  EXPECT_EQ(remark(true, false), "  sorted pixel by pixel");
  EXPECT_EQ(remark(true, true), "  out of order");
}

TEST(PixelReport, FactsAreAllNumbers) {
  PixelExplanation pixel = some_pixel();
  pixel.error = 0.25;
  EXPECT_EQ(pixel_json(pixel, two_fields()), PixelJson::parse(R"({"x": 21, "y": 14,
    "fields": {"color": "c", "extinction": "e"}, "segments": [
      {"part": "skin", "cell": 3, "depth": 1.25, "light": [0.5, 0.25, 0.125], "opacity": 0.75,
       "transparency": 0.25, "color": [0.11, 0.12, 0.13], "in_group": false},
      {"part": "inside", "cell": 17, "kind": "brick8",
       "front": {"depth": 1.5, "color_field": 0.25, "extinction_field": 2.0,
                 "kappa": [0.1, 0.2, 0.3], "tau": 4.0},
       "back": {"depth": 2.5, "color_field": 0.125, "extinction_field": 3.0,
                "kappa": [0.4, 0.5, 0.6], "tau": 8.0},
       "length": 1.25, "psi": 0.875,
       "isosurfaces": [{"field": "s", "value": 0.75, "depth": 1.75, "color": [0.01, 0.02, 0.03],
                        "opacity": 0.5}],
       "transparency": 0.0625, "color": [0.7, 0.8, 0.9], "error": 1.5e-11, "in_group": false,
       "out_of_order": false},
      {"part": "edge", "cell": null, "depth": 1.25, "light": [0.5, 0.25, 0.125], "opacity": 0.75,
       "transparency": 0.25, "color": [0.11, 0.12, 0.13], "in_group": true}],
    "ended": false, "transparency": 0.03125, "background": [0.5, 1.0, 0.0],
    "color": [0.1, 0.2, 0.3], "alpha": 0.5, "error": 0.25})"));
  Scene bare = two_fields();
  bare.volume.color.reset();
  bare.volume.extinction.reset();
  pixel.segments.clear();
  pixel.error.reset();
  pixel.ended = true;
  const PixelJson facts = pixel_json(pixel, bare);
  EXPECT_TRUE(facts["fields"]["color"].is_null() && facts["fields"]["extinction"].is_null());
  EXPECT_TRUE(facts["error"].is_null());
  EXPECT_EQ(facts["ended"], true);
}

}  // namespace
}  // namespace hiac::tools
