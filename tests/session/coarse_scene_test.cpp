#include "hiac/session/coarse_scene.hpp"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "hiac/session/session.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

ZooMesh some_mesh() {
  ZooMesh mesh = test::structured(3, test::Cut::prisms);
  test::add_node_field(mesh, "f", test::smooth_field);
  return mesh;
}

void expect_same_pixels(Session& session, const Scene& scene, std::uint32_t step) {
  PictureRequest request;
  request.background = false;
  const Image whole = session.picture(scene, request).image;
  const CoarseScene coarse = coarse_scene(scene, step);
  EXPECT_EQ(view_hash(coarse.scene), view_hash(scene));
  const Image image = session.picture(coarse.scene, request).image;
  double seen = 0;
  for (std::size_t j = 0; j < image.height(); ++j) {
    for (std::size_t i = 0; i < image.width(); ++i) {
      const std::int64_t x = coarse.left + static_cast<std::int64_t>(i) * step;
      const std::int64_t y = coarse.top + static_cast<std::int64_t>(j) * step;
      ASSERT_TRUE(x >= 0 && y >= 0 && x < scene.image.width && y < scene.image.height)
          << x << "," << y;
      for (std::size_t c = 0; c < 4; ++c) {
        const double there = whole.at(static_cast<std::size_t>(x), static_cast<std::size_t>(y), c);
        EXPECT_NEAR(image.at(i, j, c), there, 1e-8) << x << "," << y << " of every " << step;
        seen += there;
      }
    }
  }
  EXPECT_GT(seen, 1);
}

// The squares cover the picture, and its two ends share what reaches beyond it.
void expect_squares_cover(std::int64_t first, std::int64_t count, std::int64_t side,
                          std::int64_t step) {
  const std::int64_t before = (step - 1) / 2 - first;
  const std::int64_t beyond = count * step - before - side;
  EXPECT_GE(before, 0) << side << " by " << step;
  EXPECT_GE(beyond, before) << side << " by " << step;
  EXPECT_LE(beyond, before + 1) << side << " by " << step;
  EXPECT_LT(before + beyond, step) << side << " by " << step;
}

TEST(CoarseScene, CoversThePictureWithSquares) {
  Scene scene = starter_view(some_mesh());
  for (std::uint32_t width = 1; width <= 40; ++width) {
    scene.image = {width, 41 - width};
    for (std::uint32_t step = 2; step <= 12; ++step) {
      const CoarseScene coarse = coarse_scene(scene, step);
      expect_squares_cover(coarse.left, coarse.scene.image.width, width, step);
      expect_squares_cover(coarse.top, coarse.scene.image.height, 41 - width, step);
    }
  }
}

TEST(CoarseScene, HasPixelsOfTheWholePicture) {
  Session session(some_mesh());
  Scene scene = starter_view(session.mesh());
  scene.edges.reset();  // lines are averaged over coarse pixels
  for (const ImageSize size :
       {ImageSize{60, 40}, ImageSize{61, 47}, ImageSize{50, 33}, ImageSize{7, 80}}) {
    scene.image = size;
    for (const std::uint32_t step : {2U, 3U, 4U, 5U, 7U, 8U})
      expect_same_pixels(session, scene, step);
  }
  scene.camera.projection = Projection::orthographic;
  scene.camera.height = 2;
  scene.camera.fov = 0;
  scene.image = {61, 40};
  for (const std::uint32_t step : {2U, 3U, 5U, 6U}) expect_same_pixels(session, scene, step);
  scene.camera.shift = {3.5, -7.25};  // of the whole picture itself
  for (const std::uint32_t step : {2U, 3U}) expect_same_pixels(session, scene, step);
}

TEST(CoarseScene, IsTheSceneItselfWithStepOne) {
  const Scene scene = starter_view(some_mesh());
  const CoarseScene coarse = coarse_scene(scene, 1);
  EXPECT_EQ(coarse.scene, scene);
}

}  // namespace
}  // namespace hiac
