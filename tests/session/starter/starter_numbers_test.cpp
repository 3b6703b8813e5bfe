// The numbers of a first view: extinctions, isosurfaces, the view's side and lines.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/session/starter/feature_lines.hpp"
#include "hiac/session/starter/measured_depth.hpp"
#include "hiac/session/starter/starter_camera.hpp"
#include "hiac/session/starter_view.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::starter {
namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;

double ramp(const test::Position& p) { return 3 + 2 * p[0] - p[1]; }

/// A box with the field "f", which has corners' values wherever it is stored.
ZooMesh with_ramp(FieldLocation location) {
  ZooMesh mesh = test::moved(test::structured(4, test::Cut::bricks), [](const test::Position& p) {
    return test::Position{3 * p[0], 2 * p[1], p[2]};
  });
  std::vector<double> values;
  if (location == FieldLocation::node)
    for (const test::Position& p : test::positions_of(mesh)) values.push_back(ramp(p));
  if (location == FieldLocation::corner)
    for (const NodeId node : mesh.nodes)
      values.push_back(ramp({mesh.position(node)[0], mesh.position(node)[1], 0}));
  if (location == FieldLocation::cell)
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
      values.push_back(static_cast<double>(cell % 7) + 0.5);
  mesh.fields.push_back({"f", "", location, 1, std::move(values)});
  return mesh;
}

/// The mean depth of the extinctions that a view's points make of the field.
double depth_of(const ZooMesh& mesh, const Scene& scene) {
  const auto function = scene.volume.extinction->function();
  const Field& field = mesh.fields[0];
  return measure_depth(mesh, scene.camera, scene.image,
                       [&](CellId cell, std::size_t corner) {
                         const std::size_t at =
                             field.location == FieldLocation::node   ? mesh.cell_nodes(cell)[corner]
                             : field.location == FieldLocation::cell ? cell
                                                                     : mesh.elems[cell] + corner;
                         return function(field.values[at])[0];
                       })
      .mean;
}

TEST(StarterNumbers, TheMeanDepthIsOneWhereverTheFieldIsStored) {
  for (const FieldLocation location :
       {FieldLocation::node, FieldLocation::corner, FieldLocation::cell}) {
    const ZooMesh mesh = with_ramp(location);
    const Scene scene = make_starter_view(mesh, "m").scene;
    const auto& points = scene.volume.extinction->points;
    ASSERT_EQ(points.size(), 2U);
    const bool in_cells = location == FieldLocation::cell;
    EXPECT_EQ(points[0].scalar, in_cells ? 0.5 : 1);
    EXPECT_EQ(points[1].scalar, in_cells ? 6.5 : 9);
    EXPECT_NEAR(points[0].value[0] / points[1].value[0], 0.4, 1e-3);
    EXPECT_NEAR(depth_of(mesh, scene), 1, 2e-3);  // extinctions have four digits
    const Scene between = make_starter_view(mesh, "m", {.isovalues = 2}).scene;
    EXPECT_NEAR(depth_of(mesh, between), 0.3, 1e-3);
  }
}

TEST(StarterNumbers, OneValueHasOneExtinction) {
  ZooMesh mesh = test::structured(2, test::Cut::bricks);
  mesh.fields.push_back({"f", "", FieldLocation::cell, 1, std::vector<double>(8, 2.5)});
  const StarterView view = make_starter_view(mesh, "m", {.field = "f", .isovalues = 2});
  ASSERT_EQ(view.scene.volume.extinction->points.size(), 1U);
  EXPECT_EQ(view.scene.volume.extinction->points[0].scalar, 2.5);
  EXPECT_NEAR(depth_of(mesh, view.scene), 0.3, 1e-3);
  EXPECT_THAT(view.scene.isosurfaces, IsEmpty());  // there are no values between
}

TEST(StarterNumbers, AMeshWithoutAKnownExtinctionHasTheExtinctionOne) {
  ZooMesh mesh = test::structured(1, test::Cut::bricks);
  mesh.fields.push_back(
      {"f", "", FieldLocation::node, 1, std::vector<double>{std::nan(""), 1, 2, 3, 4, 5, 6, 7}});
  const StarterView view = make_starter_view(mesh, "m", {.field = "f"});
  EXPECT_EQ(view.scene.volume.extinction->points.back().value[0], 1);
  EXPECT_THAT(view.notes, Contains("no ray of a coarse grid meets a cell: the extinction is 1"));
  EXPECT_THAT(make_starter_view(with_ramp(FieldLocation::node), "m").notes,
              ElementsAre("shows 'f' from 1 to 9"));
}

TEST(StarterNumbers, IsosurfacesAreEvenlySpaced) {
  const ZooMesh mesh = with_ramp(FieldLocation::node);  // from 1 to 9
  const auto surfaces = [&](std::uint32_t count) {
    return make_starter_view(mesh, "m", {.isovalues = count}).scene.isosurfaces;
  };
  const std::vector<Isosurface> one = surfaces(1), three = surfaces(3), six = surfaces(6);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].value, 5);
  EXPECT_EQ(one[0].opacity, 0.8);
  ASSERT_EQ(three.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(three[i].value, 3 + 2 * static_cast<double>(i));
    EXPECT_EQ(three[i].opacity, 0.5);
    EXPECT_EQ(three[i].field, "f");
  }
  EXPECT_EQ(three[1].color, one[0].color);  // that of the middle of the map
  EXPECT_NE(three[0].color, one[0].color);
  ASSERT_EQ(six.size(), 6U);
  EXPECT_EQ(six[0].value, 2.143);  // 1 + 8 / 7
  EXPECT_EQ(six[5].value, 7.857);
}

TEST(StarterNumbers, ARangeThatIsGivenReplacesTheMeshs) {
  const ZooMesh mesh = with_ramp(FieldLocation::node);
  const StarterView view = make_starter_view(mesh, "m", {.range = {{-7, 25}}});
  EXPECT_EQ(view.scene.volume.color->points.front().scalar, -7);
  EXPECT_EQ(view.scene.volume.color->points.back().scalar, 25);
  EXPECT_EQ(view.scene.volume.extinction->points.front().scalar, -7);
  EXPECT_NEAR(depth_of(mesh, view.scene), 1, 2e-3);
  EXPECT_THAT(view.notes, ElementsAre("shows 'f' from -7 to 25, the range of all steps"));
}

TEST(StarterNumbers, TheBoxOfASeriesIsSeen) {
  const ZooMesh mesh = with_ramp(FieldLocation::node);  // 3 x 2 x 1
  Box box = box_of_cells(mesh);
  box.high[2] = 3;
  const Camera own = make_starter_view(mesh, "m").scene.camera;
  const Camera series = make_starter_view(mesh, "m", {.box = box}).scene.camera;
  EXPECT_NEAR(own.look_at[2], 0.5, 0.2);
  EXPECT_NEAR(series.look_at[2], 1.5, 0.2);
  const auto distance = [](const Camera& camera) { return length(view_direction(camera)); };
  EXPECT_GT(distance(series), 1.1 * distance(own));
}

/// From where a first view of this size looks, as a unit vector.
Vec side_of(const ZooMesh& mesh, std::optional<ImageSize> size) {
  const Camera camera = make_starter_view(mesh, "m", {.size = size}).scene.camera;
  return unit(-1 * view_direction(camera));
}

void expect_along(const Vec& side, const Vec& direction) {
  EXPECT_LT(length(cross(side, unit(direction))), 3e-3);
  EXPECT_GT(dot(side, direction), 0);
}

// A plate across the usual direction is seen well, one along it from its edge alone.
TEST(StarterNumbers, AnotherSideIsTakenWhereTheUsualOneShowsLittle) {
  const Vec usual{0.55, -0.75, 0.45}, second{0.75, 0.55, 0.45};
  const auto plate = [](double x, double y) {
    return test::moved(test::structured(2, test::Cut::bricks), [&](const test::Position& p) {
      const double thin = 0.002 * p[0];
      return test::Position{thin * x - p[1] * y, thin * y + p[1] * x, p[2]};
    });
  };
  expect_along(side_of(test::structured(2, test::Cut::bricks), ImageSize{100, 75}), usual);
  expect_along(side_of(plate(0.55, -0.75), ImageSize{100, 75}), usual);
  expect_along(side_of(plate(0.75, 0.55), ImageSize{100, 75}), second);
  expect_along(side_of(plate(0.75, 0.55), std::nullopt), second);
}

TEST(StarterNumbers, LongMeshesHaveAFlatPictureUnlessASizeIsAskedFor) {
  const ZooMesh mesh =
      test::moved(test::structured(2, test::Cut::bricks), [](const test::Position& p) {
        return test::Position{p[0], p[1], 30 * p[2]};
      });
  const ImageSize high = make_starter_view(mesh, "m").scene.image;
  EXPECT_EQ(high.height, 768U);
  EXPECT_LT(high.width, 200U);
  EXPECT_EQ(make_starter_view(mesh, "m", {.size = {{1024, 768}}}).scene.image,
            (ImageSize{1024, 768}));
  EXPECT_EQ(make_starter_view(test::structured(2, test::Cut::bricks), "m").scene.image,
            (ImageSize{1024, 768}));
}

// Of square pictures, which all have one camera, lines cover pixels in proportion to the side, and
// the mesh in proportion to its square: both sides of the picture in which that is a quarter.
TEST(StarterNumbers, LinesAreLeftOutWhereTheyCoverMoreThanAQuarter) {
  ZooMesh mesh;  // loose bricks
  for (int k = 0; k < 6; ++k) {
    const ZooMesh brick =
        test::moved(test::structured(1, test::Cut::bricks), [&](const test::Position& p) {
          return test::Position{1.2 * (k % 3) + p[0], 1.2 * (k / 3) + p[1], p[2]};
        });
    mesh = k == 0 ? brick : test::side_by_side(mesh, brick);
  }
  test::add_node_field(mesh, "f", ramp);
  const Camera camera = make_starter_view(mesh, "m", {.size = {{100, 100}}}).scene.camera;
  const double coverage =
      measure_depth(mesh, camera, {100, 100}, [](CellId, std::size_t) { return 1.0; }).coverage;
  const double length = line_length(mesh, Edges{}, camera, {100, 100}) / 100;
  const auto quarter = static_cast<std::uint32_t>(4 * length / coverage);
  ASSERT_GT(quarter, 20U);
  for (const std::uint32_t side : {quarter / 2, quarter - 1, quarter + 2, 3 * quarter}) {
    const StarterView view = make_starter_view(mesh, "m", {.size = {{side, side}}});
    EXPECT_EQ(view.scene.camera, camera);
    EXPECT_EQ(view.scene.edges.has_value(), side > quarter) << side;
    EXPECT_EQ(testing::Value(view.notes, Contains("leaves the feature edges out: they would cover "
                                                  "much of the model ([edges] draws them)")),
              side < quarter);
  }
}

TEST(StarterNumbers, LinesStandOutFromTheBackground) {
  const ZooMesh mesh = with_ramp(FieldLocation::node);
  const Scene light = make_starter_view(mesh, "m").scene;
  const Scene dark = make_starter_view(mesh, "m", {.dark = true}).scene;
  EXPECT_THAT(light.background.color, Each(1));
  EXPECT_THAT(dark.background.color, Each(0.01));
  EXPECT_THAT(light.edges->color, Each(0));
  EXPECT_THAT(dark.edges->color, Each(0.6));
  EXPECT_EQ(dark.edges->width, 1);
}

}  // namespace
}  // namespace hiac::starter
