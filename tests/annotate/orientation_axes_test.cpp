#include "hiac/annotate/orientation_axes.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "hiac/frame/projection.hpp"
#include "tests/annotate/annotated_scene.hpp"

namespace hiac {
namespace {

Scene random_scene(std::mt19937& random, Projection projection) {
  std::normal_distribution<double> normal;
  Scene scene = test::colored_scene({640, 480});
  for (std::size_t k = 0; k < 3; ++k) {
    scene.camera.eye[k] = 5 * normal(random);
    scene.camera.look_at[k] = normal(random);
    scene.camera.up[k] = normal(random);
  }
  scene.camera.projection = projection;
  scene.camera.height = 2;
  return scene;
}

TEST(OrientationAxes, AgreeWithProjectedPoints) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 200; ++trial) {
    const auto projection = trial % 2 == 0 ? Projection::perspective : Projection::orthographic;
    const Scene scene = random_scene(random, projection);
    const Projector projector(scene.camera, scene.image);
    const auto axes = seen_axes(scene.camera, scene.image);
    const auto centre = projector.project_extended(scene.camera.look_at);
    for (std::size_t k = 0; k < 3; ++k) {
      // a short step along the axis, forth and back: the derivative of the projection
      std::array<double, 3> ahead = scene.camera.look_at, behind = ahead;
      const double step = 1e-4;
      ahead[k] += step;
      behind[k] -= step;
      const auto a = projector.project_extended(ahead), b = projector.project_extended(behind);
      double pixels = projector.pixels_per_unit();
      if (projector.perspective()) pixels /= projector.parameter(scene.camera.look_at);
      EXPECT_NEAR(static_cast<double>(a[0] - b[0]) / (2 * step * pixels), axes[k].x, 1e-5);
      EXPECT_NEAR(static_cast<double>(a[1] - b[1]) / (2 * step * pixels), axes[k].y, 1e-5);
      EXPECT_NEAR(axes[k].x * axes[k].x + axes[k].y * axes[k].y + axes[k].away * axes[k].away, 1,
                  1e-12);
      // deeper along the axis is farther away
      EXPECT_EQ(axes[k].away > 0, a[2] > centre[2]) << axes[k].away;
    }
  }
}

/// The mean position of what an axis of the square adds to it, from its middle.
CanvasPoint middle_of_color(const Canvas& canvas, const Color& color) {
  double weight = 0, x = 0, y = 0;
  for (int j = 0; j < canvas.height(); ++j)
    for (int i = 0; i < canvas.width(); ++i) {
      const auto pixel =
          canvas.image().pixel(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
      double away = 0;
      for (std::size_t c = 0; c < 3; ++c) away += std::abs(pixel[c] - color[c]);
      if (pixel[3] < 0.5 || away > 0.02) continue;
      weight += 1;
      x += i + 0.5 - canvas.width() / 2.0;
      y += j + 0.5 - canvas.height() / 2.0;
    }
  return {x / weight, y / weight};
}

TEST(OrientationAxes, ArrowsPointWhereTheAxesDo) {
  const Color dark[] = {{0.78, 0.08, 0.08}, {0.05, 0.45, 0.1}, {0.1, 0.2, 0.85}};
  std::mt19937 random(4);
  for (int trial = 0; trial < 60; ++trial) {
    const Scene scene = random_scene(random, Projection::perspective);
    const auto axes = seen_axes(scene.camera, scene.image);
    AxesAnnotation wanted;
    wanted.size = {200, true};
    const Canvas canvas = test::drawn(orientation_axes(wanted, scene, {16}));
    for (std::size_t k = 0; k < 3; ++k) {
      const double seen = std::hypot(axes[k].x, axes[k].y);
      if (seen < 0.6) continue;
      const CanvasPoint found = middle_of_color(canvas, dark[k]);
      const double cosine =
          (found.x * axes[k].x + found.y * axes[k].y) / (seen * std::hypot(found.x, found.y));
      EXPECT_GT(cosine, 0.98) << trial << " " << k;
      EXPECT_GT(std::hypot(found.x, found.y), 25);
    }
  }
}

TEST(OrientationAxes, StayInTheirSquareWhateverTheView) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 60; ++trial) {
    Scene scene = random_scene(random, Projection::orthographic);
    if (trial < 3) {  // along an axis: its arrow is a dot
      scene.camera.eye = scene.camera.look_at;
      scene.camera.eye[static_cast<std::size_t>(trial)] += 2;
    }
    AxesAnnotation wanted;
    wanted.size = {trial % 2 == 0 ? 120.0 : 30.0, true};
    const Canvas canvas = test::drawn(orientation_axes(wanted, scene, {16}));
    double ink = 0, rim = 0;
    for (int j = 0; j < canvas.height(); ++j)
      for (int i = 0; i < canvas.width(); ++i) {
        const double alpha = test::alpha(canvas, i, j);
        ink += alpha;
        if (i == 0 || j == 0 || i + 1 == canvas.width() || j + 1 == canvas.height()) rim += alpha;
      }
    EXPECT_GT(ink, wanted.size.value / 2) << trial;
    EXPECT_EQ(rim, 0) << trial;
  }
}

}  // namespace
}  // namespace hiac
