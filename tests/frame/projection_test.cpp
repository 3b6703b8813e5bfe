#include "hiac/frame/projection.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using test::Position;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// Looks along -y from (1, 7, 2), with z upwards, so that x points to the left.
Camera camera_along_y(Projection projection) {
  Camera camera;
  camera.projection = projection;
  camera.eye = {1, 7, 2};
  camera.look_at = {1, 3, 2};
  camera.up = {0, -5, 2};  // not at a right angle
  camera.fov = 90;         // 80 pixels at the distance 1 are 2 units
  camera.height = 5;
  return camera;
}

constexpr ImageSize kProjectedSize{120, 80};

TEST(ProjectionOfPoints, IsThatOfAPinholeInPerspective) {
  const Projector projector(camera_along_y(Projection::perspective), kProjectedSize);
  EXPECT_TRUE(projector.perspective());
  EXPECT_DOUBLE_EQ(projector.pixels_per_unit(), 40);
  EXPECT_EQ(projector.near(), 0);
  EXPECT_EQ(projector.far(), kNoLimit);
  ProjectedNode node{};
  // 2 in front of the eye, 0.5 to the right and 0.25 up
  ASSERT_TRUE(projector.project(Position{0.5, 5, 2.25}, node));
  EXPECT_NEAR(node.x, 60 + 40 * 0.25, 1e-12);
  EXPECT_NEAR(node.y, 40 - 40 * 0.125, 1e-12);
  EXPECT_DOUBLE_EQ(node.depth, -0.5);
  EXPECT_DOUBLE_EQ(projector.parameter(Position{0.5, 5, 2.25}), 2);
  EXPECT_EQ(projector.distance(2), 2);
  EXPECT_EQ(projector.relative(Position{0.5, 5, 2.25}), (Position{-0.5, -2, 0.25}));
}

TEST(ProjectionOfPoints, ShiftMovesThePictureAsAWhole) {
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    Camera camera = camera_along_y(projection);
    const Projector plain(camera, kProjectedSize);
    camera.shift = {3.5, -7.25};
    const Projector shifted(camera, kProjectedSize);
    EXPECT_EQ(shifted.pixels_per_unit(), plain.pixels_per_unit());
    ProjectedNode before{}, after{};
    for (const Position& point : {Position{0.5, 5, 2.25}, {1, 3, 2}, {1.5, -4, 1}}) {
      ASSERT_TRUE(plain.project(point, before));
      ASSERT_TRUE(shifted.project(point, after));
      EXPECT_NEAR(after.x, before.x + 3.5, 1e-12);
      EXPECT_NEAR(after.y, before.y - 7.25, 1e-12);
      EXPECT_EQ(after.depth, before.depth);
    }
    EXPECT_EQ(shifted.direction(13.5, 2.25), plain.direction(10, 9.5));
    EXPECT_EQ(shifted.origin(13.5, 2.25), plain.origin(10, 9.5));
    EXPECT_EQ(shifted.slopes(13.5, 2.25), plain.slopes(10, 9.5));
    EXPECT_EQ(shifted.extended_slopes(13.5, 2.25), plain.extended_slopes(10, 9.5));
  }
}

TEST(ProjectionOfPoints, IsParallelInOrthographicViews) {
  const Projector projector(camera_along_y(Projection::orthographic), kProjectedSize);
  EXPECT_FALSE(projector.perspective());
  EXPECT_DOUBLE_EQ(projector.pixels_per_unit(), 16);  // 80 pixels are 5 units
  EXPECT_EQ(projector.near(), -kNoLimit);
  EXPECT_EQ(projector.far(), kNoLimit);
  ProjectedNode node{};
  // 0.5 to the right of what is looked at, 0.25 up, and 2 nearer to the eye, which is 4 away
  ASSERT_TRUE(projector.project(Position{0.5, 5, 2.25}, node));
  EXPECT_NEAR(node.x, 60 + 8, 1e-12);
  EXPECT_NEAR(node.y, 40 - 4, 1e-12);
  EXPECT_DOUBLE_EQ(node.depth, -2);
  EXPECT_DOUBLE_EQ(projector.parameter(Position{0.5, 5, 2.25}), -2);
  EXPECT_DOUBLE_EQ(projector.distance(-2), 2);
  EXPECT_EQ(projector.relative(Position{0.5, 5, 2.25}), (Position{-0.5, 2, 0.25}));
  EXPECT_EQ(projector.ray_scale(3, 4), 1);
}

TEST(ProjectionOfPoints, ClippingIsByDistanceFromTheEyePlane) {
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    Camera camera = camera_along_y(projection);
    camera.clip = {{1.5, 3}};
    const Projector projector(camera, kProjectedSize);
    EXPECT_DOUBLE_EQ(projector.distance(projector.near()), 1.5);
    EXPECT_DOUBLE_EQ(projector.distance(projector.far()), 3);
    EXPECT_DOUBLE_EQ(projector.near(), projection == Projection::perspective ? 1.5 : -2.5);
    EXPECT_DOUBLE_EQ(static_cast<double>(projector.extended_near()), projector.near());
    EXPECT_DOUBLE_EQ(static_cast<double>(projector.extended_far()), projector.far());
  }
}

// The ray through a point's projection passes the point, at its parameter.
TEST(ProjectionOfPoints, RaysPassThePointsOfTheirPixels) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const Projection projection : {Projection::perspective, Projection::orthographic})
    for (int i = 0; i < 100; ++i) {
      Camera camera;
      camera.projection = projection;
      for (std::size_t c = 0; c < 3; ++c) {
        camera.eye[c] = 5 + number(random);
        camera.look_at[c] = number(random);
        camera.up[c] = number(random);
      }
      camera.fov = 60;
      camera.height = 3;
      const Projector projector(camera, kProjectedSize);
      const Position point{number(random), number(random), number(random)};
      ProjectedNode node{};
      ASSERT_TRUE(projector.project(point, node));
      const double t = projector.parameter(point);
      EXPECT_NEAR(node.depth, projection == Projection::perspective ? -1 / t : t, 1e-14);
      const auto [a, b] = projector.slopes(node.x, node.y);
      const auto [ea, eb] = projector.extended_slopes(node.x, node.y);
      EXPECT_NEAR(a, static_cast<double>(ea), 1e-15);
      EXPECT_NEAR(b, static_cast<double>(eb), 1e-15);
      const Position from = projector.origin(node.x, node.y),
                     offset = projector.relative_origin(node.x, node.y),
                     along = projector.direction(node.x, node.y),
                     camera_point = projector.camera_coordinates(point);
      const auto axes = projector.axes();
      const bool perspective = projection == Projection::perspective;
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(from[c] + t * along[c], point[c], 1e-13);
        EXPECT_NEAR(offset[c] + t * along[c], projector.relative(point)[c], 1e-13);
        const double aside = a * axes.right[c] + b * axes.up[c];
        EXPECT_NEAR(offset[c], perspective ? 0 : aside, 1e-15);
        EXPECT_NEAR(along[c], axes.forward[c] + (perspective ? aside : 0), 1e-15);
        EXPECT_NEAR(camera_point[0] * axes.right[c] + camera_point[1] * axes.up[c] +
                        camera_point[2] * axes.forward[c],
                    projector.relative(point)[c], 1e-14);
      }
      EXPECT_NEAR(camera_point[0], a * (perspective ? t : 1), 1e-13);
      EXPECT_NEAR(camera_point[1], b * (perspective ? t : 1), 1e-13);
      EXPECT_NEAR(projector.ray_scale(node.x, node.y), std::hypot(along[0], along[1], along[2]),
                  1e-14);
      EXPECT_EQ(axes.center_x, 60);
      EXPECT_EQ(axes.center_y, 40);
    }
}

TEST(ProjectionOfPoints, NodesBehindTheEyeOrTooFarAsideAreNone) {
  const Projector projector(camera_along_y(Projection::perspective), kProjectedSize);
  const Projector parallel(camera_along_y(Projection::orthographic), kProjectedSize);
  ProjectedNode node{};
  const auto at = [&](double right, double up, double forward) {
    const Position point{1 - right, 7 - forward, 2 + up};
    EXPECT_TRUE(parallel.project(point, node));
    return projector.project(point, node);
  };
  EXPECT_TRUE(at(0, 0, 1));
  EXPECT_FALSE(at(0, 0, -1));
  EXPECT_FALSE(at(0.5, 0.5, 0));
  // 131072 pixels from the centre and more
  const double border = 131072 / 40.0;
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(at(side * (border - 0.01), 0, 1));
    EXPECT_FALSE(at(side * (border + 0.01), 0, 1));
    EXPECT_TRUE(at(0, side * (border - 0.01), 1));
    EXPECT_FALSE(at(0, side * (border + 0.01), 1));
  }
}

TEST(ProjectionOfPoints, NodesAlmostOnCentresOfPixelsAreMovedOntoThem) {
  Camera camera = camera_along_y(Projection::orthographic);
  camera.height = 80;  // a pixel is a unit
  camera.look_at = {0, 0, 0};
  camera.eye = {0, 4, 0};
  const Projector projector(camera, kProjectedSize);
  ProjectedNode node{};
  for (const double side : {-1.0, 1.0}) {
    const double near = side * 0x1p-38, far = side * 0x1.1p-38;
    ASSERT_TRUE(projector.project(Position{-3.5 - near, 0, 7.5 - near}, node));
    EXPECT_EQ(node.x, 63.5);
    EXPECT_EQ(node.y, 32.5);
    ASSERT_TRUE(projector.project(Position{-3.5 - far, 0, 7.5 - far}, node));
    EXPECT_EQ(node.x, 63.5 + far);
    EXPECT_EQ(node.y, 32.5 + far);
    ASSERT_TRUE(projector.project(Position{-3 - near, 0, 7 - near}, node));  // a pixel's border
    EXPECT_EQ(node.x, 63 + near);
    EXPECT_EQ(node.y, 33 + near);
  }
}

TEST(ProjectionOfPoints, OfMeshesHasNoDepthWhereThereIsNone) {
  const ZooMesh mesh = test::make_mesh({{1, 5, 2}, {1, 9, 2}, {0, 5, 2}, {1, 5, 3}},
                                       {{CellKind::tetrahedron4, {3, 0, 2, 1}}});
  const Projector projector(camera_along_y(Projection::perspective), kProjectedSize);
  const std::vector<ProjectedNode> nodes = project_nodes(mesh, projector);
  ASSERT_EQ(nodes.size(), 4U);
  for (std::size_t k : {0U, 2U, 3U}) EXPECT_DOUBLE_EQ(nodes[k].depth, -0.5);
  EXPECT_TRUE(std::isnan(nodes[1].depth));  // behind the eye
  EXPECT_DOUBLE_EQ(nodes[2].x, 80);
  EXPECT_DOUBLE_EQ(nodes[3].y, 20);
  const auto relative = relative_positions(mesh, 0, projector);
  EXPECT_EQ(relative[0], (Position{0, -2, 1}));
  EXPECT_EQ(relative[1], (Position{0, -2, 0}));
  EXPECT_EQ(relative[2], (Position{-1, -2, 0}));
  EXPECT_EQ(relative[3], (Position{0, 2, 0}));
}

}  // namespace
}  // namespace hiac
