#include "hiac/frame/crop.hpp"

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/view_of.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/sorting.hpp"

namespace hiac {
namespace {

// Cells for the tetrahedron kernel and others, some of them beside the eye.
ZooMesh mesh_of_all_kinds() {
  ZooMesh mesh =
      test::side_by_side(test::moved(test::mixed_columns(1), test::tapered),
                         test::moved(test::random_delaunay(15, 1), [](const test::Position& p) {
                           return test::Position{p[0] - 1.5, p[1], p[2]};
                         }));
  test::add_random_field(mesh, "f", FieldLocation::node, 2);
  return mesh;
}

VisibilityOrder order_of_scene(const ZooMesh& mesh, const Scene& scene) {
  return test::sorted(mesh, view_of(scene.camera)).order;
}

void expect_part_of(const Image& whole, const Image& part, const PixelRect& rect) {
  ASSERT_EQ(part.width(), rect.width);
  ASSERT_EQ(part.height(), rect.height);
  for (std::uint32_t y = 0; y < rect.height; ++y)
    for (std::uint32_t x = 0; x < rect.width; ++x)
      for (std::size_t c = 0; c < whole.channel_count(); ++c)
        ASSERT_EQ(part.at(x, y, c), whole.at(rect.x + x, rect.y + y, c)) << x << ' ' << y;
}

TEST(Crop, HasThePixelsOfTheWholePicture) {
  const ZooMesh mesh = mesh_of_all_kinds();
  for (const std::uint32_t splat_below : {0U, 40U})
    for (const auto& eye : {test::Position{3.1, 2.3, 2.7}, {0.2, 0.3, 0.3}}) {
      Scene scene = test::cube_scene(Projection::perspective, 100, 75);
      scene.camera.eye = eye;
      scene.camera.fov = 60;
      scene.background = {BackgroundPattern::checker, {0.1, 0.2, 0.3}, {1, 0.5, 0}, 7};
      scene.render.splat_below = splat_below;
      scene.render.tolerance = 1e-3;
      const VisibilityOrder order = order_of_scene(mesh, scene);
      const auto channels = parse_channels(splat_below > 0 ? "depth,mean_depth,cells,witness"
                                                           : "depth,mean_depth,cells,error");
      const RenderResult whole = render(mesh, order, scene, true, nullptr, channels);
      EXPECT_GT(whole.statistics.covered_pixels, 500U);
      const PartRenderer renderer(mesh, order, scene, channels);
      for (const PixelRect& rect : {PixelRect{0, 0, 100, 75},
                                    {60, 28, 10, 8},
                                    {64, 32, 36, 32},
                                    {50, 40, 1, 1},
                                    {99, 0, 1, 75},
                                    {3, 61, 90, 9}}) {
        const RenderResult part = renderer.render(rect, true);
        expect_part_of(whole.image, part.image, rect);
        EXPECT_EQ(part.statistics.splatted_cells, whole.statistics.splatted_cells);
      }
    }
}

TEST(Crop, WorksOnTheTilesThatItNeeds) {
  const ZooMesh mesh = mesh_of_all_kinds();
  Scene scene = test::cube_scene(Projection::perspective, 192, 128);
  scene.render.tolerance = 1e-3;
  const VisibilityOrder order = order_of_scene(mesh, scene);
  const PartRenderer renderer(mesh, order, scene);
  // tiles are 64 x 32 pixels: their segments, one tile after the other, are those of the picture
  std::uint64_t segments = 0;
  RenderStatistics sum;
  for (std::uint32_t y = 0; y < 128; y += 32)
    for (std::uint32_t x = 0; x < 192; x += 64) {
      const RenderStatistics one = renderer.render({x, y, 64, 32}, false).statistics;
      EXPECT_EQ(renderer.render({x + 20, y + 5, 30, 11}, false).statistics.segments, one.segments);
      segments += one.segments;
      sum += one;
    }
  const RenderStatistics whole = render(mesh, order, scene, false).statistics;
  EXPECT_EQ(segments, whole.segments);
  EXPECT_EQ(sum.segments, whole.segments);
  EXPECT_EQ(sum.covered_pixels, whole.covered_pixels);
  EXPECT_NEAR(sum.mean_optical_depth, whole.mean_optical_depth, 1e-12);
  EXPECT_EQ(sum.largest_optical_depth, whole.largest_optical_depth);
  EXPECT_EQ(sum.depth_pixels, whole.depth_pixels);
}

TEST(Crop, MustLieInThePicture) {
  const ImageSize size{40, 30};
  EXPECT_NO_THROW(require_inside(whole_picture(size), size));
  EXPECT_NO_THROW(require_inside({39, 29, 1, 1}, size));
  for (const PixelRect& rect : {PixelRect{0, 0, 0, 5},
                                {0, 0, 5, 0},
                                {40, 0, 1, 1},
                                {0, 30, 1, 1},
                                {39, 0, 2, 1},
                                {1, 0, 40, 1},
                                {1, 1, 0xffffffff, 1},
                                {0xffffffff, 0, 2, 1}})
    EXPECT_THROW(require_inside(rect, size), UsageError);
}

}  // namespace
}  // namespace hiac
