#include "tests/preview/method_reference.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/preview/drawn.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::preview {
namespace {

using test::drawn;

// Coarse and dense, so that the methods differ by far more than what is allowed.
Scene dense_scene(Projection projection, Glow glow) {
  Scene scene = test::smooth_scene(projection, glow);
  scene.image = {40, 30};
  scene.camera.eye = {2.9, -2.8, 2.6};
  scene.camera.fov = 22;
  scene.volume.color = ColorTransfer{"f", {{-0.1, {0, 0.3, 1}}, {1.1, {1, 0.7, 0}}}};
  scene.volume.extinction = ExtinctionTransfer{"f", {{-0.1, {0}}, {1.1, {60}}}};
  return scene;
}

// Along the view.
double slope(const test::Position& p) { return (p[0] + 1 - p[1] + p[2]) / 3; }

// Largest difference over the pixels of a picture.
double difference(const ZooMesh& mesh, const Scene& scene, Method method, Method reference) {
  const Image image = drawn(mesh, scene, method).image;
  const auto cells = test::back_to_front(mesh, scene);
  double largest = 0;
  for (std::uint32_t y = 0; y < scene.image.height; ++y)
    for (std::uint32_t x = 0; x < scene.image.width; ++x) {
      const auto truth = test::method_pixel(mesh, scene, reference, cells, x, y);
      for (std::size_t c = 0; c < 4; ++c)
        largest = std::max(largest, std::abs(image.at(x, y, c) - truth[c]));
    }
  return largest;
}

TEST(MethodReference, IsWhatTheShadersDraw) {
  ZooMesh mesh = test::random_delaunay(8, 11);
  test::add_node_field(mesh, "f", slope);
  for (const Projection projection : {Projection::orthographic, Projection::perspective})
    for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
      const Scene scene = dense_scene(projection, glow);
      for (const Method method : {Method::interpolated_opacity, Method::mean_color, Method::tables,
                                  Method::exact_at_vertices})
        EXPECT_LE(difference(mesh, scene, method, method), 2e-3)
            << "M" << static_cast<int>(method) << ", projection " << static_cast<int>(projection)
            << ", glow " << static_cast<int>(glow);
      // the methods are not one and the same
      EXPECT_GT(difference(mesh, scene, Method::interpolated_opacity, Method::mean_color), 1e-2);
      EXPECT_GT(difference(mesh, scene, Method::mean_color, Method::exact_at_vertices), 3e-3);
    }
}

// Bends and steps, in places of their own. Nowhere is the extinction constant, where M2 would fall
// back to M1 or not by rounding.
Scene sliced_scene(Projection projection, Glow glow, double densest) {
  Scene scene = dense_scene(projection, glow);
  scene.volume.color->points = {
      {0.2, {1, 0, 0}}, {0.35, {0, 1, 0}}, {0.35, {0, 0, 1}}, {0.8, {1, 1, 0}}};
  scene.volume.extinction->points = {{-0.1, {0}},
                                     {0.3, {densest}},
                                     {0.47, {densest / 5}},
                                     {0.47, {1.2 * densest}},
                                     {1.1, {densest / 10}}};
  return scene;
}

TEST(MethodReference, IsWhatTheShadersDrawOfSlabs) {
  for (const std::size_t points : {1U, test::kInstrumented ? 5U : 25U}) {
    ZooMesh mesh = test::random_delaunay(points, 12);
    test::add_node_field(mesh, "f", slope);
    for (const Projection projection : {Projection::orthographic, Projection::perspective})
      for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
        const Scene scene = sliced_scene(projection, glow, points == 1 ? 25 : 9);
        for (const Method method : {Method::interpolated_opacity, Method::mean_color,
                                    Method::tables, Method::exact_at_vertices})
          EXPECT_LE(difference(mesh, scene, method, method), 2e-3)
              << points << " points, M" << static_cast<int>(method) << ", projection "
              << static_cast<int>(projection) << ", glow " << static_cast<int>(glow);
        if (points > 1) continue;
        // of large slabs the methods draw something else each
        EXPECT_GT(difference(mesh, scene, Method::interpolated_opacity, Method::mean_color), 1e-2);
        EXPECT_GT(difference(mesh, scene, Method::mean_color, Method::exact_at_vertices), 3e-3);
      }
  }
}

}  // namespace
}  // namespace hiac::preview
