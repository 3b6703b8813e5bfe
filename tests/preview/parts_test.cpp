#include <algorithm>

#include "hiac/preview/float_target.hpp"
#include "tests/preview/preview_support.hpp"

namespace hiac {
namespace {

class PreviewParts : public test::WithDriver {};

TEST(PartsOf, CoverARectangleOnce) {
  const auto parts = preview::parts_of({3, 5, 10, 7}, 4);
  ASSERT_EQ(parts.size(), 6U);
  std::size_t pixels = 0;
  for (const PixelRect& part : parts) {
    EXPECT_TRUE(part.x >= 3 && part.x + part.width <= 13 && part.width <= 4);
    EXPECT_TRUE(part.y >= 5 && part.y + part.height <= 12 && part.height <= 4);
    pixels += std::size_t{part.width} * part.height;
  }
  EXPECT_EQ(pixels, 70U);
}

TEST_F(PreviewParts, HaveTheSamePixels) {
  const ZooMesh mesh = test::delaunay_with_fields(200, 21);
  for (const bool inside : {false, true}) {
    Scene scene = test::benchmark_scene(Projection::perspective, 150, 110);
    if (inside) {
      scene.camera.eye = {0.4, 0.5, 0.6};
      scene.camera.fov = 80;
    }
    const Image whole = preview_of(mesh, scene);
    const Image in_parts = preview_of(mesh, scene, {.part_side = 37});
    EXPECT_TRUE(std::ranges::equal(whole.values(), in_parts.values()));
  }
}

TEST_F(PreviewParts, ACropHasThePixelsOfTheWhole) {
  const ZooMesh mesh = test::delaunay_with_fields(100, 22);
  const Scene scene = test::benchmark_scene(Projection::orthographic, 150, 110);
  const Image whole = preview_of(mesh, scene);
  preview::Preview engine(context(), mesh, scene);
  const PixelRect part{60, 40, 50, 30};
  const Image crop =
      engine.draw(scene.camera, test::exact_order_of(mesh, scene), part, false).image;
  for (std::uint32_t y = 0; y < part.height; ++y)
    for (std::uint32_t x = 0; x < part.width; ++x)
      EXPECT_TRUE(std::ranges::equal(crop.pixel(x, y), whole.pixel(60 + x, 40 + y)));
}

TEST_F(PreviewParts, TheBackgroundShowsThrough) {
  const ZooMesh mesh = test::lattice_with_fields(2);
  Scene scene = test::benchmark_scene(Projection::orthographic, 40, 30);
  scene.background.color = {0.25, 0.5, 0.75};
  preview::Preview engine(context(), mesh, scene);
  const VisibilityOrder order = test::exact_order_of(mesh, scene);
  const Image without = engine.draw(scene.camera, order, {}, false).image;
  const Image with = engine.draw(scene.camera, order, {}, true).image;
  for (std::uint32_t y = 0; y < 30; ++y)
    for (std::uint32_t x = 0; x < 40; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_DOUBLE_EQ(with.at(x, y, c), without.at(x, y, c) + (1 - without.at(x, y, 3)) *
                                                                     scene.background.color[c]);
}

}  // namespace
}  // namespace hiac
