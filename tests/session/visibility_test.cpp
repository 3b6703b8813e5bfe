#include "hiac/session/visibility.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/session/session.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

/// The unit cube with the field x, from 0 to 1.
ZooMesh cube() {
  ZooMesh mesh = test::structured(2, test::Cut::bricks);
  test::add_node_field(mesh, "x", [](const test::Position& p) { return p[0]; });
  return mesh;
}

Scene good_view() {
  Scene scene = starter_view(cube());
  scene.image = {32, 24};
  return scene;
}

/// The line after drawing, if any.
std::string reason(const Scene& scene, std::optional<PixelRect> part = std::nullopt) {
  const ZooMesh mesh = cube();
  PictureRequest request;
  request.part = part;
  const Picture picture = Session(mesh).picture(scene, request);
  return reason_of_empty(mesh, scene,
                         {picture.covered_pixels, picture.largest_optical_depth, part.has_value()})
      .value_or("");
}

Isosurface surface(double value) {
  Isosurface made;
  made.field = "x";
  made.value = value;
  return made;
}

TEST(Visibility, GoodPicturesGiveNoReason) {
  Scene scene = good_view();
  EXPECT_THAT(invisible_parts(cube(), scene), IsEmpty());
  EXPECT_EQ(reason(scene), "");
  scene.volume.extinction->points = {{0.5, {1}}};  // constant, wherever it is
  scene.volume.color->points = {{7, {1, 0, 0}}};
  scene.isosurfaces = {surface(0), surface(0.5), surface(1)};
  EXPECT_THAT(invisible_parts(cube(), scene), IsEmpty());
  scene.volume.extinction.reset();
  EXPECT_THAT(invisible_parts(cube(), scene), IsEmpty());
  EXPECT_EQ(reason(scene), "");
  scene.isosurfaces.clear();
  scene.volume.glow = Glow::emission;
  EXPECT_THAT(invisible_parts(cube(), scene), IsEmpty());
  EXPECT_EQ(reason(scene), "");
}

TEST(Visibility, EdgesDoNotHideThatTheMediumIsNotSeen) {
  Scene scene = good_view();
  ASSERT_TRUE(scene.edges && !scene.skin);
  EXPECT_EQ(reason(scene), "");
  for (auto& point : scene.volume.extinction->points) point.value[0] *= 1e-5;
  EXPECT_THAT(reason(scene), HasSubstr("the medium is too thin to be seen"));
  for (auto& point : scene.volume.extinction->points) point.value[0] = 0;
  EXPECT_THAT(invisible_parts(cube(), scene), ElementsAre(HasSubstr("zero for all values of 'x'")));
}

TEST(Visibility, PointsThatTheFieldDoesNotMeet) {
  for (const double shift : {-3.0, 3.0}) {
    Scene scene = good_view();
    for (auto& point : scene.volume.color->points) point.scalar += shift;
    EXPECT_THAT(invisible_parts(cube(), scene),
                ElementsAre(AllOf(HasSubstr("volume.color: the points go from "),
                                  HasSubstr("the values of 'x' from 0 to 1: they do not meet"),
                                  HasSubstr("volume.color.range = \"auto\""))));
    scene = good_view();
    scene.volume.extinction->points = {{shift, {1}}, {shift + 1, {2}}};
    EXPECT_THAT(invisible_parts(cube(), scene),
                ElementsAre(HasSubstr("volume.extinction: the poi")));
  }
  Scene touching = good_view();
  touching.volume.extinction->points = {{1, {1}}, {2, {2}}};
  EXPECT_THAT(invisible_parts(cube(), touching), IsEmpty());
}

TEST(Visibility, ExtinctionThatIsZero) {
  Scene scene = good_view();
  scene.volume.extinction->points = {{0, {0}}, {1, {0}}, {2, {5}}, {3, {5}}};
  EXPECT_THAT(
      invisible_parts(cube(), scene),
      ElementsAre(HasSubstr("volume.extinction: zero for all values of 'x' (from 0 to 1)")));
  scene.volume.extinction->points = {{0, {0}}, {0.5, {0}}, {0.5, {5}}, {0.6, {0}}};
  EXPECT_THAT(invisible_parts(cube(), scene), IsEmpty());
  scene.volume.extinction->points = {{0, {0}}};
  scene.isosurfaces = {surface(0.5)};
  EXPECT_THAT(invisible_parts(cube(), scene), IsEmpty());
  scene.isosurfaces.clear();
  scene.volume.extinction.reset();
  EXPECT_THAT(invisible_parts(cube(), scene), IsEmpty());  // edges are drawn
  scene.edges.reset();
  EXPECT_THAT(invisible_parts(cube(), scene), ElementsAre(HasSubstr("nothing is drawn")));
}

TEST(Visibility, IsovaluesThatTheFieldDoesNotHave) {
  Scene scene = good_view();
  scene.isosurfaces = {surface(0.5), surface(1.5), surface(-1)};
  EXPECT_THAT(invisible_parts(cube(), scene),
              ElementsAre(AllOf(HasSubstr("isosurface.1: 'x' has values from 0 to 1, never 1.5"),
                                HasSubstr("isosurface.1.value = 0.5")),
                          HasSubstr("isosurface.2: 'x' has values from 0 to 1, never -1")));
}

TEST(Visibility, ValuesOfEveryNodeAreFound) {
  Scene scene = good_view();
  for (const FieldLocation where : {FieldLocation::node, FieldLocation::corner}) {
    for (std::size_t k = 0; k < 4; ++k) {
      ZooMesh mesh = test::make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                     {{CellKind::tetrahedron4, {0, 1, 2, 3}}});
      std::vector<double> values(4, 0);
      values[k] = 1;
      mesh.fields.push_back({"x", "", where, 1, std::move(values)});
      scene.isosurfaces = {surface(1), surface(2), surface(-1)};
      EXPECT_THAT(
          invisible_parts(mesh, scene),
          ElementsAre(HasSubstr("'x' has values from 0 to 1, never 2"), HasSubstr("never -1")))
          << k;
    }
  }
}

// A quadratic field of a cell overshoots its nodes: the surface is there.
TEST(Visibility, IsovaluesBetweenNodesAreFound) {
  ZooMesh mesh = test::make_mesh({{0, 0, 0},
                                  {1, 0, 0},
                                  {0, 1, 0},
                                  {0, 0, 1},
                                  {.5, 0, 0},
                                  {.5, .5, 0},
                                  {0, .5, 0},
                                  {0, 0, .5},
                                  {.5, 0, .5},
                                  {0, .5, .5}},
                                 {{CellKind::tetrahedron10, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}});
  std::vector<double> values(10, 0);
  values[4] = values[5] = 1;  // the edge from node 1 overshoots between 4 and 5
  mesh.fields.push_back({"x", "", FieldLocation::node, 1, std::move(values)});
  Scene scene = good_view();
  scene.isosurfaces = {surface(1.05)};
  EXPECT_THAT(invisible_parts(mesh, scene), IsEmpty());
  scene.isosurfaces = {surface(9)};
  EXPECT_THAT(invisible_parts(mesh, scene), SizeIs(1));
}

TEST(Visibility, ACameraThatLooksAway) {
  Scene scene = good_view();
  const Camera good = scene.camera;
  for (std::size_t a = 0; a < 3; ++a) scene.camera.look_at[a] = 2 * good.eye[a] - good.look_at[a];
  EXPECT_THAT(reason(scene), AllOf(HasSubstr("the camera looks away"), HasSubstr("behind the eye"),
                                   HasSubstr("camera.look_at = [0.5, 0.5, 0.5]")));
  scene.camera = good;
  scene.camera.look_at[2] += 2;
  EXPECT_THAT(reason(scene), HasSubstr("the camera looks past the mesh"));
  scene.camera = good;
  EXPECT_THAT(reason(scene, PixelRect{0, 0, 2, 2}), HasSubstr("in this part of the picture"));
}

TEST(Visibility, ASlabThatMisses) {
  Scene scene = good_view();
  scene.camera.clip = {{1000, 2000}};
  EXPECT_THAT(reason(scene), HasSubstr("camera.clip = [1000, 2000] misses the mesh"));
  scene.camera.clip = {{0, 1e-3}};
  EXPECT_THAT(reason(scene), HasSubstr("camera.clip = [0, 0.001] misses the mesh"));
  scene.camera.clip = {{0, 1000}};
  EXPECT_EQ(reason(scene), "");
}

TEST(Visibility, AMediumThatIsTooThin) {
  Scene scene = good_view();
  for (auto& point : scene.volume.extinction->points) point.value[0] *= 1e-4;
  EXPECT_THAT(reason(scene), HasSubstr("the medium is too thin to be seen: its optical depth"));
  for (auto& point : scene.volume.extinction->points) point.value[0] *= 1e3;
  EXPECT_EQ(reason(scene), "");
}

// Distances along the view direction, not from the eye: the cube lies 3 to 4 in front of it.
TEST(Visibility, DistancesOfAMissedMeshAreTold) {
  const ZooMesh mesh = cube();
  Scene scene = good_view();
  scene.camera.eye = {0.5, -3, 9};
  scene.camera.look_at = {0.5, -1, 9};
  const auto told = [&](double near, double far) {
    scene.camera.clip = {{near, far}};
    return reason_of_empty(mesh, scene, {0, 0, false}).value_or("");
  };
  const auto misses = [](const std::string& clip) {
    return "no cell is seen: camera.clip = [" + clip +
           "] misses the mesh, which lies 3 to 4 from the eye along the view direction";
  };
  EXPECT_EQ(told(1, 2.5), misses("1, 2.5"));
  EXPECT_EQ(told(4.5, 7), misses("4.5, 7"));
  const std::string past =
      "no cell is seen: the camera looks past the mesh, or from so far that it is smaller than a "
      "pixel (camera.look_at = [0.5, 0.5, 0.5] looks at the middle of the mesh)";
  EXPECT_EQ(told(1, 3), past);
  EXPECT_EQ(told(4, 7), past);
  EXPECT_EQ(told(3.5, 3.6), past);
  EXPECT_EQ(reason_of_empty(mesh, scene, {0, 0, true}),
            "no cell is seen in this part of the picture (another part shows some)");
  EXPECT_EQ(reason_of_empty(ZooMesh{}, scene, {0, 0, true}), "no cell is seen: the mesh has none");
  scene.camera.look_at = {0.5, -5, 9};
  EXPECT_EQ(told(1, 2),
            "no cell is seen: the camera looks away, all of the mesh is behind the eye "
            "(camera.look_at = [0.5, 0.5, 0.5] looks at the middle of the mesh)");
  scene.camera.projection = Projection::orthographic;
  EXPECT_THAT(told(1, 2), HasSubstr("which lies -4 to -3 from the eye"));
}

TEST(Visibility, AMediumIsSeenFromHalfAStepOf8BitsOn) {
  const ZooMesh mesh = cube();
  Scene scene = good_view();
  const auto told = [&](double depth) {
    return reason_of_empty(mesh, scene, {10, depth, false}).value_or("");
  };
  const double step = -std::log1p(-0.5 / 255);
  EXPECT_EQ(told(1.001 * step), "");
  EXPECT_EQ(told(0.001),
            "the medium is too thin to be seen: its optical depth is at most 0.001 "
            "(extinctions 1e+03 times as large reach 1)");
  EXPECT_NE(told(0.999 * step), "");
  EXPECT_EQ(told(0), "");  // then another line says that nothing is drawn
  scene.skin.emplace();
  EXPECT_EQ(told(0.001), "");
  scene.skin.reset();
  scene.isosurfaces = {surface(0.5)};
  EXPECT_EQ(told(0.001), "");
  scene.isosurfaces.clear();
  scene.volume.glow = Glow::emission;
  EXPECT_EQ(told(0.001), "");
  for (auto& point : scene.volume.color->points) point.value = {0, 0, 0};
  EXPECT_NE(told(0.001), "");
  scene.volume.extinction.reset();
  EXPECT_EQ(told(0.001), "");
}

// Cells are looked through in parts of 4096.
TEST(Visibility, ValuesOfEveryPartOfManyCellsAreFound) {
  ZooMesh mesh = test::structured(21, test::Cut::bricks);  // 9261 cells
  Scene scene = good_view();
  for (const std::size_t cell : {0U, 4095U, 4096U, 8191U, 8192U, 9260U}) {
    std::vector<double> values(mesh.cell_count(), 0);
    values[cell] = 3;
    mesh.fields.clear();
    mesh.fields.push_back({"x", "", FieldLocation::cell, 1, std::move(values)});
    scene.isosurfaces = {surface(3), surface(3.5)};
    EXPECT_THAT(invisible_parts(mesh, scene),
                ElementsAre(HasSubstr("isosurface.1: 'x' has values from 0 to 3, never 3.5")))
        << cell;
  }
}

// Polynomials in world coordinates overshoot: values within the field's extent beyond are let pass.
TEST(Visibility, PolynomialsMayOvershoot) {
  Scene scene = good_view();
  scene.render.interpolation = Interpolation::polynomial;
  scene.isosurfaces = {surface(1.9), surface(-0.9), surface(2.1), surface(-1.1)};
  EXPECT_THAT(invisible_parts(cube(), scene),
              ElementsAre(HasSubstr("isosurface.2: 'x' has values from -1 to 2, never 2.1"),
                          HasSubstr("isosurface.3: 'x' has values from -1 to 2, never -1.1")));
}

TEST(Visibility, ColoursOfTheSkinThatTheFieldDoesNotMeet) {
  Scene scene = good_view();
  scene.skin.emplace().color_by = ColorTransfer{"x", {{2, {1, 0, 0}}, {3, {0, 1, 0}}}};
  EXPECT_THAT(invisible_parts(cube(), scene),
              ElementsAre("skin.color: the points go from 2 to 3, the values of 'x' from 0 to 1: "
                          "they do not meet, and everything has one value (skin.color.range = "
                          "\"auto\" with points on 0 to 1 follows the field)"));
  scene.skin->color_by->points[1].value = {1, 0, 0};  // one colour in any case
  EXPECT_THAT(invisible_parts(cube(), scene), IsEmpty());
  EXPECT_THAT(invisible_parts(ZooMesh{}, scene), IsEmpty());
}

}  // namespace
}  // namespace hiac
