#include "hiac/render/engine.hpp"

#include <cmath>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/reference.hpp"

namespace hiac {
namespace {

using test::Cut;

Scene scene_of(Projection projection, std::uint32_t width, std::uint32_t height) {
  Scene scene;
  scene.image = {width, height};
  scene.camera.projection = projection;
  scene.camera.eye = {3.1, 2.3, 2.7};
  scene.camera.look_at = {0.5, 0.5, 0.5};
  scene.camera.up = {0, 0, 1};
  scene.camera.fov = 27;
  scene.camera.height = 1.75;
  scene.volume.color = ColorTransfer{
      "f",
      {{0.0, {0.1, 0.2, 0.9}}, {0.35, {0.2, 0.9, 0.3}}, {0.6, {0.95, 0.8, 0.1}}, {1, {0.9, 0.1, 0.1}}}};
  scene.volume.extinction = ExtinctionTransfer{
      "f", {{0.0, {0.2}}, {0.25, {0.6}}, {0.45, {4}}, {0.55, {0.5}}, {0.8, {6}}, {1, {1}}}};
  scene.render.tolerance = 1e-15;
  return scene;
}

OrderResult order_of_scene(const ZooMesh& mesh, const Scene& scene) {
  const View view{scene.camera.projection == Projection::perspective, scene.camera.eye,
                  view_direction(scene.camera)};
  return exact_order(mesh, build_face_adjacency(mesh), view, scene.render.planarity);
}

RenderResult draw(const ZooMesh& mesh, const Scene& scene) {
  return render(mesh, order_of_scene(mesh, scene).order, scene, false);
}

// The largest difference of any channel from the brute-force reference.
double largest_error(const ZooMesh& mesh, const Scene& scene, const Image& image,
                     std::uint32_t step = 1) {
  double largest = 0;
  for (std::uint32_t y = 0; y < scene.image.height; y += step)
    for (std::uint32_t x = 0; x < scene.image.width; x += step) {
      const auto expected = test::reference_pixel(mesh, scene, x, y);
      for (std::size_t c = 0; c < 4; ++c)
        largest = std::max(largest, std::abs(expected[c] - image.at(x, y, c)));
    }
  return largest;
}

ZooMesh delaunay_with_fields(std::size_t points, std::uint64_t seed) {
  ZooMesh mesh = test::random_delaunay(points, seed);
  test::add_node_field(mesh, "f", test::smooth_field);
  test::add_node_field(mesh, "g", [](const test::Position& p) {
    return 0.5 * (p[0] * p[0] + p[1] * (1 - p[2]));
  });
  return mesh;
}

TEST(Engine, DelaunayAgreesWithBruteForce) {
  const ZooMesh mesh = delaunay_with_fields(120, 1);
  for (const Projection projection : {Projection::orthographic, Projection::perspective})
    for (const Glow glow : {Glow::chromaticity, Glow::emission})
      for (const bool separate : {false, true}) {
        Scene scene = scene_of(projection, 48, 40);
        scene.volume.glow = glow;
        if (separate) scene.volume.color->field = "g";
        const RenderResult result = draw(mesh, scene);
        EXPECT_EQ(result.statistics.violations, 0U);
        EXPECT_GT(result.statistics.covered_pixels, 500U);
        EXPECT_LE(largest_error(mesh, scene, result.image), 1e-12)
            << "perspective " << (projection == Projection::perspective) << " emission "
            << (glow == Glow::emission) << " separate " << separate;
      }
}

TEST(Engine, StepsInTransferFunctionsAgreeWithBruteForce) {
  const ZooMesh mesh = delaunay_with_fields(60, 2);
  Scene scene = scene_of(Projection::perspective, 40, 40);
  scene.volume.color->points = {{0.3, {1, 0, 0}}, {0.3, {0, 1, 0}}, {0.6, {0, 0, 1}},
                                {0.6, {1, 1, 0}}};
  scene.volume.extinction->points = {{0.2, {0}}, {0.2, {5}}, {0.4, {0}}, {0.5, {0}},
                                     {0.5, {9}}, {0.7, {1}}};
  EXPECT_LE(largest_error(mesh, scene, draw(mesh, scene).image), 1e-12);
}

}  // namespace
}  // namespace hiac
