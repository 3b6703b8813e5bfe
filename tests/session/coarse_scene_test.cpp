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
  std::uint64_t inside = 0;
  double seen = 0;
  for (std::size_t j = 0; j < image.height(); ++j) {
    for (std::size_t i = 0; i < image.width(); ++i) {
      const std::int64_t x = coarse.left + static_cast<std::int64_t>(i) * step;
      const std::int64_t y = coarse.top + static_cast<std::int64_t>(j) * step;
      if (x < 0 || y < 0 || x >= scene.image.width || y >= scene.image.height) continue;
      ++inside;
      for (std::size_t c = 0; c < 4; ++c) {
        const double there = whole.at(static_cast<std::size_t>(x), static_cast<std::size_t>(y), c);
        EXPECT_NEAR(image.at(i, j, c), there, 1e-8) << x << "," << y;
        seen += there;
      }
    }
  }
  EXPECT_EQ(inside, coarse.pixels);
  EXPECT_GT(seen, 1);
  // the squares around them cover the picture
  const std::int64_t half = (step - 1) / 2;
  EXPECT_LE(coarse.left - half, 0);
  EXPECT_LE(coarse.top - half, 0);
  EXPECT_GE(coarse.left + (coarse.scene.image.width - std::int64_t{1}) * step + half,
            scene.image.width - std::int64_t{1});
  EXPECT_GE(coarse.top + (coarse.scene.image.height - std::int64_t{1}) * step + half,
            scene.image.height - std::int64_t{1});
}

TEST(CoarseScene, HasPixelsOfTheWholePicture) {
  Session session(some_mesh());
  Scene scene = starter_view(session.mesh());
  scene.edges.reset();  // lines are averaged over coarse pixels
  for (const ImageSize size :
       {ImageSize{60, 40}, ImageSize{61, 47}, ImageSize{50, 33}, ImageSize{7, 80}}) {
    scene.image = size;
    for (const std::uint32_t step : {3U, 5U, 7U}) expect_same_pixels(session, scene, step);
  }
  scene.camera.projection = Projection::orthographic;
  scene.camera.height = 2;
  scene.camera.fov = 0;
  scene.image = {61, 40};
  for (const std::uint32_t step : {3U, 5U}) expect_same_pixels(session, scene, step);
}

TEST(CoarseScene, IsTheSceneItselfWithStepOne) {
  const Scene scene = starter_view(some_mesh());
  const CoarseScene coarse = coarse_scene(scene, 1);
  EXPECT_EQ(coarse.scene, scene);
  EXPECT_EQ(coarse.pixels, std::uint64_t{scene.image.width} * scene.image.height);
}

}  // namespace
}  // namespace hiac
