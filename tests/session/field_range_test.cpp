#include "hiac/session/field_range.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/image/srgb.hpp"
#include "hiac/scene/colormaps/built_in_colormaps.hpp"
#include "hiac/session/field_values.hpp"
#include "hiac/session/session.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string kView =
    "[image]\nwidth = 64\nheight = 8\n"
    "[camera]\nprojection = 'orthographic'\neye = [0.5, -3, 0.5]\nlook_at = [0.5, 0, 0.5]\n"
    "up = [0, 0, 1]\nheight = 0.125\n";

ParsedScene view(const std::string& text) { return parse_scene(kView + text, "view.toml"); }

/// One tetrahedron with the values of a field at its nodes, and a node that belongs to no cell.
ZooMesh tetrahedron(std::vector<double> values) {
  ZooMesh mesh = test::make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {9, 9, 9}},
                                 {{CellKind::tetrahedron4, {0, 1, 2, 3}}});
  mesh.fields.push_back({"f", "", FieldLocation::node, 1, std::move(values)});
  return mesh;
}

std::vector<double> scalars(const std::string& keys, const ZooMesh& mesh) {
  const ParsedScene parsed = with_field_ranges(
      view("[volume.extinction]\nfield = 'f'\npoints = [[0, 1], [1, 3]]\n" + keys), mesh);
  EXPECT_FALSE(parsed.extinction);
  EXPECT_EQ(parsed.notes.size(), 1U);
  std::vector<double> found;
  for (const auto& point : parsed.scene.volume.extinction->points) found.push_back(point.scalar);
  return found;
}

using Scalars = std::vector<double>;

TEST(FieldRange, StretchesTheColoursOfTheSkin) {
  const ParsedScene parsed = with_field_ranges(
      view("[skin.color]\nfield = 'f'\nrange = 'auto'\npoints = [[0, 1, 0, 0], [1, 0, 1, 0]]\n"),
      tetrahedron({4, 1, 3, 2, 1000}));
  EXPECT_FALSE(parsed.skin_color);
  const auto& points = parsed.scene.skin->color_by->points;
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].scalar, 1);
  EXPECT_EQ(points[1].scalar, 4);
}

TEST(FieldRange, FollowsTheValuesThatBelongToCells) {
  const ZooMesh mesh = tetrahedron({4, 1, 3, 2, 1000});
  EXPECT_EQ(scalars("range = 'auto'\n", mesh), (Scalars{1, 4}));
  // numpy.percentile([1, 2, 3, 4], [10, 75]) is [1.3, 3.25]
  const Scalars percentiles = scalars("range = 'percentile:10,75'\n", mesh);
  ASSERT_EQ(percentiles.size(), 2U);
  EXPECT_DOUBLE_EQ(percentiles[0], 1.3);
  EXPECT_DOUBLE_EQ(percentiles[1], 3.25);
  EXPECT_EQ(scalars("range = 'percentile:0,100'\n", tetrahedron({4, NAN, 3, 2, -5})),
            (Scalars{2, 4}));
}

TEST(FieldRange, ALogarithmicScaleSpansThePositiveValues) {
  const Scalars found =
      scalars("range = 'auto'\nscale = 'log'\n", tetrahedron({0, 1e-2, -3, 1e2, 0}));
  EXPECT_GT(found.size(), 10U);
  EXPECT_EQ(found.front(), 1e-2);
  EXPECT_EQ(found.back(), 1e2);
  EXPECT_THAT(
      [] {
        scalars("range = 'auto'\nscale = 'log'\n", tetrahedron({0, -1, -3, 0, 1}));
      },
      ThrowsMessage<InputError>(HasSubstr("field 'f': has no positive value")));
}

TEST(FieldRange, OneValueTakesTheMiddleOfThePoints) {
  const ParsedScene parsed = with_field_ranges(
      view("[volume.extinction]\nfield = 'f'\nrange = 'auto'\npoints = [[0, 1], [1, 3]]\n"),
      tetrahedron({7, 7, 7, 7, 0}));
  ASSERT_EQ(parsed.scene.volume.extinction->points.size(), 1U);
  EXPECT_EQ(parsed.scene.volume.extinction->points[0].scalar, 7);
  EXPECT_EQ(parsed.scene.volume.extinction->points[0].value[0], 2);
  EXPECT_THAT(parsed.notes[0], HasSubstr("the one value 7"));
}

TEST(FieldRange, RefusesFieldsWithoutValues) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(
      [] {
        scalars("range = 'auto'\n", tetrahedron({kNone, kNone, kNone, kNone, 1}));
      },
      ThrowsMessage<InputError>(HasSubstr("field 'f': has no finite value")));
  EXPECT_THAT(
      [] {
        scalars("range = 'auto'\n", tetrahedron({1e120, 0, 0, 0, 1}));
      },
      ThrowsMessage<InputError>(HasSubstr("too large")));
  EXPECT_THROW(with_field_ranges(view("[volume.color]\nfield = 'g'\npreset = 'viridis'\n"),
                                 tetrahedron({0, 1, 2, 3, 4})),
               UsageError);
}

// An opaque cell with the field x from 0 to 1 across the picture shows the colour map's display
// values.
TEST(FieldRange, AnOpaqueMediumShowsThePresetsDisplayValues) {
  ZooMesh mesh = test::structured(1, test::Cut::bricks);
  test::add_node_field(mesh, "x", [](const test::Position& p) { return p[0]; });
  for (const std::string& name : built_in_colormap_names()) {
    const ParsedScene parsed =
        with_field_ranges(view("[volume.color]\nfield = 'x'\npreset = '" + name +
                               "'\n[volume.extinction]\nfield = 'x'\npoints = [[0, 1e7]]\n"),
                          mesh);
    const Image image = Session(mesh).picture(parsed.scene).image;
    const ColormapPreset preset = *built_in_colormap(name);
    double largest = 0;
    for (std::size_t i = 0; i < 64; ++i) {
      const auto shown = preset_color(preset, (static_cast<double>(i) + 0.5) / 64);
      for (std::size_t c = 0; c < 3; ++c)
        largest = std::fmax(largest, std::fabs(srgb_encode(image.at(i, 4, c)) - shown[c]));
    }
    EXPECT_LT(largest, 1.0 / 255) << name;
    EXPECT_GT(largest, 0) << name;
  }
}

// The truth is the range of one mesh that has the values of all steps.
TEST(FieldRange, ASeriesHasOneRange) {
  const std::vector<Scalars> steps{{4, 1, 3, 2, 1000}, {9, 1, -1, 6, 1000}, {5, 5, NAN, 8, -70}};
  Scalars all;
  for (const Scalars& values : steps)
    for (std::size_t node = 0; node < 4; ++node) all.push_back(values[node]);
  for (const std::string keys :
       {"range = 'auto'\n", "range = 'percentile:10,75'\n", "range = 'auto'\nscale = 'log'\n"}) {
    const ParsedScene parsed =
        view("[volume.extinction]\nfield = 'f'\npoints = [[0, 1], [1, 3]]\n" + keys);
    FieldRanges ranges(parsed, 2);
    EXPECT_TRUE(ranges.are_open());
    for (const Scalars& values : steps) ranges.add(tetrahedron(values));
    const ParsedScene series = ranges.place(parsed);
    // cell fields count as they are
    ZooMesh mesh = test::make_mesh(
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        std::vector<test::Cell>(all.size(), {CellKind::tetrahedron4, {0, 1, 2, 3}}));
    mesh.fields.push_back({"f", "", FieldLocation::cell, 1, Scalars(all)});
    const ParsedScene truth = with_field_ranges(parsed, mesh);
    EXPECT_EQ(series.scene, truth.scene) << keys;
    ASSERT_EQ(series.notes.size(), 1U);
    EXPECT_EQ(series.notes[0], truth.notes[0] + " over 3 steps");
    EXPECT_FALSE(series.extinction);
  }
}

TEST(FieldRange, AFixedRangeNeedsNoMesh) {
  EXPECT_FALSE(FieldRanges(view("[volume.extinction]\nfield = 'f'\nrange = [1, 2]\n"
                                "points = [[0, 1], [1, 3]]\n"))
                   .are_open());
}

const std::string kThreeRanges =
    "[volume.color]\nfield = 'f'\nrange = 'percentile:5,95'\n"
    "points = [[0, 1, 0, 0], [1, 0, 1, 0]]\n"
    "[volume.extinction]\nfield = 'g'\nrange = 'auto'\nscale = 'log'\n"
    "points = [[0, 1], [1, 3]]\n"
    "[skin.color]\nfield = 'h'\nrange = 'auto'\npoints = [[0, 1, 0, 0], [1, 0, 1, 0]]\n";

TEST(FieldRange, WhatIsWantedIsToldOfEveryOpenRange) {
  const std::vector<FieldRanges::Wanted> wanted = FieldRanges(view(kThreeRanges)).wanted();
  ASSERT_EQ(wanted.size(), 3U);
  EXPECT_EQ(wanted[0].field, "f");
  EXPECT_EQ(wanted[0].percents, (std::array<double, 2>{5, 95}));
  EXPECT_FALSE(wanted[0].logarithmic);
  EXPECT_EQ(wanted[1].field, "g");
  EXPECT_EQ(wanted[1].percents, (std::array<double, 2>{0, 100}));
  EXPECT_TRUE(wanted[1].logarithmic);
  EXPECT_EQ(wanted[2].field, "h");
  const FieldRanges fixed(
      view("[volume.color]\nfield = 'f'\nrange = [0, 1]\n"
           "points = [[0, 1, 0, 0], [1, 0, 1, 0]]\n"
           "[volume.extinction]\nfield = 'g'\nrange = 'auto'\n"
           "points = [[0, 1], [1, 3]]\n"));
  ASSERT_EQ(fixed.wanted().size(), 1U);
  EXPECT_EQ(fixed.wanted()[0].field, "g");
}

// Where values are found elsewhere: percentiles are those already, so that they are ends here.
TEST(FieldRange, EndsThatAreFoundElsewhereAreThoseOfThePoints) {
  const ParsedScene parsed = view(kThreeRanges);
  FieldRanges ranges(parsed);
  const std::vector<Interval> ends{{-2, 6}, {0.1, 1000}, {7, 7}};
  ranges.set_ends(ends);
  const ParsedScene placed = ranges.place(parsed);
  EXPECT_FALSE(placed.color || placed.extinction || placed.skin_color);
  const Volume& volume = placed.scene.volume;
  EXPECT_EQ(volume.color->points.front().scalar, -2);
  EXPECT_EQ(volume.color->points.back().scalar, 6);
  EXPECT_EQ(volume.extinction->points.front().scalar, 0.1);
  EXPECT_EQ(volume.extinction->points.back().scalar, 1000);
  ASSERT_EQ(placed.scene.skin->color_by->points.size(), 1U);
  EXPECT_EQ(placed.scene.skin->color_by->points[0].value, (Color{0.5, 0.5, 0}));
  EXPECT_THAT(placed.notes,
              testing::ElementsAre("volume.color.range: 'f' from -2 to 6",
                                   "volume.extinction.range: 'g' from 0.1 to 1000",
                                   "skin.color.range: 'h' has the one value 7, and takes the "
                                   "middle of the points"));
  FieldRanges without(parsed);
  const std::vector<Interval> none{{-2, 6}, {}, {7, 7}};
  without.set_ends(none);
  EXPECT_THAT([&] { without.place(parsed); },
              ThrowsMessage<InputError>(HasSubstr("field 'g': has no positive value")));
}

TEST(FieldRange, ValuesUpTo1e100MakeARange) {
  EXPECT_EQ(scalars("range = 'auto'\n", tetrahedron({1e100, 0, 0, -1e100, 1})),
            (Scalars{-1e100, 1e100}));
  EXPECT_THAT(
      [] {
        scalars("range = 'auto'\n", tetrahedron({0, 1, 2, -1.5e100, 1}));
      },
      ThrowsMessage<InputError>(
          HasSubstr("field 'f': values are too large (at most 1e+100 in magnitude expected, "
                    "-1.5e+100 found)")));
}

TEST(FieldRange, OnlyValuesOfCellsHaveToBeFinite) {
  const auto is_finite = [](const ZooMesh& mesh) {
    return is_finite_in_cells(mesh, mesh.fields.back());
  };
  EXPECT_TRUE(is_finite(tetrahedron({4, 1, 3, 2, NAN})));
  EXPECT_FALSE(is_finite(tetrahedron({4, 1, 3, NAN, 2})));
  ZooMesh mesh = tetrahedron({0, 0, 0, 0, 0});
  for (const double value : {1.0, double{INFINITY}}) {
    mesh.fields.push_back({"c", "", FieldLocation::cell, 1, Scalars{value}});
    EXPECT_EQ(is_finite(mesh), value == 1);
    mesh.fields.push_back({"k", "", FieldLocation::corner, 1, Scalars{1, 2, value, 4}});
    EXPECT_EQ(is_finite(mesh), value == 1);
    EXPECT_EQ(values_in_cells(mesh, mesh.fields.back()),
              value == 1 ? (Scalars{1, 2, 1, 4}) : (Scalars{1, 2, 4}));
  }
  EXPECT_EQ(values_in_cells(mesh, tetrahedron({4, NAN, 3, 2, 8}).fields[0]), (Scalars{4, 3, 2}));
}

}  // namespace
}  // namespace hiac
