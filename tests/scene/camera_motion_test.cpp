#include "hiac/scene/camera_motion.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

const ImageSize kSize{300, 200};

// Looks north along y, up is z, ten units from the origin.
Camera plain(Projection projection = Projection::perspective) {
  Camera camera{projection, {0, -10, 0}, {0, 0, 0}, {0, 0, 1}, 40, 0, {}};
  if (projection == Projection::orthographic)
    camera = {projection, {0, -10, 0}, {}, {0, 0, 1}, 0, 7, {}};
  return camera;
}

Camera random_camera(std::mt19937_64& random) {
  std::uniform_real_distribution<double> number(-3, 3);
  Camera camera = plain(random() % 2 == 0 ? Projection::perspective : Projection::orthographic);
  for (std::size_t c = 0; c < 3; ++c) {
    camera.eye[c] = number(random) + 5;
    camera.look_at[c] = number(random);
    camera.up[c] = number(random);
  }
  return camera;
}

struct Place {
  double x, y;
};

// Where a point is seen, computed from the definition of the camera: pixels from the top left.
Place seen(const Camera& camera, const Vector& point) {
  const Vector ahead = unit(view_direction(camera));
  const Vector right = unit(cross(ahead, camera.up));
  const Vector up = cross(right, ahead);
  const Vector to = minus(point, camera.eye);
  const double extent = camera.projection == Projection::orthographic
                            ? camera.height
                            : 2 * dot(to, ahead) * std::tan(camera.fov * M_PI / 360);
  return {kSize.width / 2.0 + dot(to, right) / extent * kSize.height,
          kSize.height / 2.0 - dot(to, up) / extent * kSize.height};
}

void expect_near(const Vector& a, const Vector& b, double tolerance = 1e-9) {
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << c;
}

TEST(CameraMotion, OrbitMovesWhatIsInFrontWithTheHand) {
  const Vector front{0, -1, 0};
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    const Camera before = plain(projection);
    EXPECT_GT(seen(orbited(before, 10, 0), front).x, seen(before, front).x);
    EXPECT_NEAR(seen(orbited(before, 10, 0), front).y, seen(before, front).y, 1e-9);
    EXPECT_GT(seen(orbited(before, 0, 10), front).y, seen(before, front).y);
    EXPECT_NEAR(seen(orbited(before, 0, 10), front).x, seen(before, front).x, 1e-9);
  }
  expect_near(orbited(plain(), 90, 0).eye, {-10, 0, 0});
  expect_near(orbited(plain(), 0, 90).eye, {0, 0, 10});
  expect_near(orbited(plain(), 0, 90).up, {0, 1, 0});
}

TEST(CameraMotion, OrbitKeepsTheDistanceAndGoesAroundTheWorld) {
  std::mt19937_64 random(4);
  for (int k = 0; k < 50; ++k) {
    const Camera before = random_camera(random);
    Camera after = before;
    for (int step = 0; step < 36; ++step) after = orbited(after, 10, 0);
    expect_near(after.eye, before.eye);
    after = orbited(before, 33, -71);
    EXPECT_NEAR(length(view_direction(after)), length(view_direction(before)), 1e-9);
    EXPECT_EQ(after.look_at, before.look_at);
    // over the pole and on: no direction is special
    for (int step = 0; step < 36; ++step) after = orbited(after, 0, 10);
    expect_near(after.eye, orbited(before, 33, -71).eye);
  }
}

TEST(CameraMotion, RollTurnsThePictureCounterClockwise) {
  const Vector right_of_centre{1, 0, 0};
  const Place turned = seen(rolled(plain(), 90), right_of_centre);
  EXPECT_NEAR(turned.x, kSize.width / 2.0, 1e-9);
  EXPECT_LT(turned.y, kSize.height / 2.0);
}

TEST(CameraMotion, PanMovesThePlaneThroughTheCentre) {
  std::mt19937_64 random(5);
  for (int k = 0; k < 50; ++k) {
    const Camera before = random_camera(random);
    const Place place = seen(panned(before, 0.25, 0.1), before.look_at);
    EXPECT_NEAR(place.x, kSize.width / 2.0 + 0.25 * kSize.height, 1e-8);
    EXPECT_NEAR(place.y, kSize.height / 2.0 - 0.1 * kSize.height, 1e-8);
  }
}

TEST(CameraMotion, ZoomEnlargesThePlaneThroughTheCentre) {
  std::mt19937_64 random(6);
  for (int k = 0; k < 50; ++k) {
    const Camera before = random_camera(random);
    const CameraAxes axes = axes_of(before);
    Vector point = before.look_at;
    for (std::size_t c = 0; c < 3; ++c) point[c] += 0.3 * axes.right[c];
    const double small = seen(before, point).x - kSize.width / 2.0;
    const double large = seen(zoomed(before, 1.7), point).x - kSize.width / 2.0;
    EXPECT_NEAR(large, 1.7 * small, 1e-8);
  }
}

TEST(CameraMotion, ZoomLeavesTheSlabInTheWorld) {
  Camera camera = plain();
  camera.clip = {8, 12};
  EXPECT_EQ(zoomed(camera, 2).clip, (std::array<double, 2>{3, 7}));
  EXPECT_EQ(zoomed(camera, 4).clip, (std::array<double, 2>{0.5, 4.5}));
  EXPECT_EQ(zoomed(camera, 10).clip, (std::array<double, 2>{0, 3}));
  EXPECT_EQ(zoomed(camera, 0.5).clip, (std::array<double, 2>{18, 22}));
  // a slab that would lie wholly behind the eye stays as it was
  camera.clip = {2, 5};
  EXPECT_EQ(zoomed(camera, 4).clip, (std::array<double, 2>{2, 5}));
}

// A point that is seen at a place of the picture is seen nearer to the centre by the factor.
TEST(CameraMotion, WidenedCamerasSeeMore) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> number(-2, 2);
  for (int trial = 0; trial < 100; ++trial) {
    const Camera camera = random_camera(random);
    const double factor = std::exp(0.5 * number(random));
    const Camera wide = widened(camera, factor);
    EXPECT_EQ(wide.eye, camera.eye);
    Vector point = camera.look_at;
    for (double& x : point) x += 0.1 * length(view_direction(camera)) * number(random);
    const Place before = seen(camera, point), after = seen(wide, point);
    EXPECT_NEAR((after.x - 150) * factor, before.x - 150, 1e-9);
    EXPECT_NEAR((after.y - 100) * factor, before.y - 100, 1e-9);
  }
}

TEST(CameraMotion, ProjectionKeepsTheSizeAtTheCentre) {
  std::mt19937_64 random(7);
  for (int k = 0; k < 50; ++k) {
    const Camera before = random_camera(random);
    const Projection other = before.projection == Projection::perspective ? Projection::orthographic
                                                                          : Projection::perspective;
    const Camera after = with_projection(before, other, 30);
    const CameraAxes axes = axes_of(before);
    Vector point = before.look_at;
    for (std::size_t c = 0; c < 3; ++c) point[c] += 0.2 * axes.right[c] + 0.4 * axes.up[c];
    const Place a = seen(before, point), b = seen(after, point);
    EXPECT_NEAR(a.x, b.x, 1e-8);
    EXPECT_NEAR(a.y, b.y, 1e-8);
    EXPECT_EQ(with_projection(before, before.projection, 30), before);
  }
}

TEST(CameraMotion, FramingSeesAllOfTheBall) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  for (const ImageSize size : {kSize, ImageSize{100, 400}}) {
    for (int k = 0; k < 40; ++k) {
      const Camera before = random_camera(random);
      const Vector middle{1, 2, 3};
      const double radius = 2.5;
      const Camera after = framing(before, middle, radius, size);
      expect_near(axes_of(after).ahead, axes_of(before).ahead);
      double widest = 0;
      for (int p = 0; p < 400; ++p) {
        Vector point = unit({normal(random), normal(random), normal(random)});
        for (std::size_t c = 0; c < 3; ++c) point[c] = middle[c] + radius * point[c];
        const Place place = seen(after, point);
        // `seen` is of kSize; shares of the picture's height are those of any
        const double x = std::abs(place.x - kSize.width / 2.0) / kSize.height;
        const double y = std::abs(place.y - kSize.height / 2.0) / kSize.height;
        EXPECT_LE(x, 0.5 * size.width / size.height);
        EXPECT_LE(y, 0.5);
        widest = std::max({widest, 2 * y, 2 * x * size.height / size.width});
      }
      EXPECT_GT(widest, 0.85);
    }
  }
}

TEST(CameraMotion, PointsAreWhereTheyAreSeen) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> number(0, 200);
  for (int k = 0; k < 50; ++k) {
    const Camera camera = random_camera(random);
    const double x = number(random), y = number(random), depth = 1 + number(random) / 50;
    const Vector point = point_at(camera, kSize, x, y, depth);
    EXPECT_NEAR(dot(minus(point, camera.eye), axes_of(camera).ahead), depth, 1e-9);
    const Place place = seen(camera, point);
    EXPECT_NEAR(place.x, x, 1e-7);
    EXPECT_NEAR(place.y, y, 1e-7);
    Camera shifted = camera;
    shifted.shift = {3.5, -7};
    expect_near(point_at(shifted, kSize, x + 3.5, y - 7, depth), point);
  }
}

TEST(CameraMotion, LooksAlongAndCentres) {
  const Camera side = looking_along(plain(), {1, 0, 0}, {0, 0, 1});
  expect_near(side.eye, {-10, 0, 0});
  const Camera moved = centred(plain(), {1, 2, 3});
  EXPECT_EQ(moved.look_at, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(view_direction(moved), view_direction(plain()));
}

}  // namespace
}  // namespace hiac
