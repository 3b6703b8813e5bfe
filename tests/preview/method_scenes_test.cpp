#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/preview/drawn.hpp"
#include "tests/support/meshes.hpp"

// What the methods share besides the volume's light: alpha is exact in linear tetrahedra (but for
// M0), whatever is cut, so that the accurate engine tells what it must be.
namespace hiac::preview {
namespace {

using test::accurate;
using test::drawn;
using test::errors;

ZooMesh fine_mesh() {
  ZooMesh mesh = test::random_delaunay(600, 21);
  test::add_node_field(mesh, "f", test::smooth_field);
  test::add_node_field(mesh, "g", [](const test::Position& p) { return p[0] + p[1] * p[2]; });
  return mesh;
}

double alpha_error(const Image& a, const Image& b) {
  double largest = 0;
  for (std::size_t y = 0; y < a.height(); ++y)
    for (std::size_t x = 0; x < a.width(); ++x)
      largest = std::max(largest, std::abs(a.at(x, y, 3) - b.at(x, y, 3)));
  return largest;
}

// Alpha to 1e-5 and colours nearly so, in both projections and glows.
void expect_close(const ZooMesh& mesh, const Scene& given, double allowed, const std::string& what,
                  double allowed_alpha = 2e-5) {
  for (const Projection projection : {Projection::orthographic, Projection::perspective})
    for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
      Scene scene = given;
      scene.camera.projection = projection;
      scene.volume.glow = glow;
      const Image truth = accurate(mesh, scene);
      const Image image = drawn(mesh, scene, Method::exact_at_vertices).image;
      EXPECT_LE(errors(image, truth).largest, allowed)
          << what << ", projection " << static_cast<int>(projection) << ", glow "
          << static_cast<int>(glow);
      EXPECT_LE(alpha_error(image, truth), allowed_alpha) << what;
    }
}

Scene bent_scene() {
  Scene scene = test::smooth_scene(Projection::perspective, Glow::chromaticity);
  scene.volume.color->points = {{0.1, {1, 0, 0}}, {0.3, {0, 1, 0}}, {0.7, {0, 0.2, 1}}};
  scene.volume.extinction->points = {{0.2, {0}}, {0.45, {4}}, {0.8, {1}}};
  return scene;
}

TEST(MethodScenes, SlicedCells) { expect_close(fine_mesh(), bent_scene(), 4e-3, "bends"); }

TEST(MethodScenes, FieldsOfTheirOwn) {
  Scene scene = bent_scene();
  scene.volume.extinction->field = "g";
  expect_close(fine_mesh(), scene, 4e-3, "separate fields");
}

TEST(MethodScenes, ClippingSlab) {
  Scene scene = bent_scene();
  scene.camera.clip = {2.6, 3.1};
  expect_close(fine_mesh(), scene, 4e-3, "clipped");
}

TEST(MethodScenes, TheEyeInTheMesh) {
  Scene scene = bent_scene();
  scene.camera.eye = {0.31, 0.42, 0.53};
  scene.camera.look_at = {0.9, 0.6, 0.5};
  scene.camera.fov = 70;
  expect_close(fine_mesh(), scene, 5e-3, "eye inside");
  // and in a corner of the mesh's own nodes
  const ZooMesh lattice = [] {
    ZooMesh mesh = test::structured(4, test::Cut::tetrahedra);
    test::add_node_field(mesh, "f", test::smooth_field);
    return mesh;
  }();
  scene.camera.eye = {0.5, 0.5, 0.5};
  scene.camera.look_at = {0.9, 0.63, 0.57};
  expect_close(lattice, scene, 2e-2, "eye at a node", 1e-4);
}

TEST(MethodScenes, Isosurfaces) {
  Scene scene = bent_scene();
  Isosurface half;
  half.field = "f";
  half.value = 0.4;
  half.color = {1, 0.8, 0.2};
  half.opacity = 0.4;
  Isosurface other = half;
  other.field = "g";
  other.value = 0.9;
  other.color = {0.2, 0.9, 1};
  Isosurface opaque = half;
  opaque.value = 0.75;
  opaque.opacity = 1;
  scene.isosurfaces = {half, other, opaque};
  scene.lights.push_back(Light{std::array<double, 3>{1, -2, 3}, {0.5, 0.5, 0.5}});
  // in perspective Phong's light is interpolated between the corners of a polygon
  expect_close(fine_mesh(), scene, 1e-2, "isosurfaces", 5e-5);
}

TEST(MethodScenes, AnIsosurfaceInFacesIsDrawnOnce) {
  // planes of the lattice have the value
  ZooMesh mesh = test::structured(4, test::Cut::tetrahedra);
  test::add_node_field(mesh, "f", [](const test::Position& p) { return std::abs(p[0] - 0.5); });
  Scene scene = test::smooth_scene(Projection::orthographic, Glow::chromaticity);
  scene.volume = {};
  Isosurface surface;
  surface.field = "f";
  surface.value = 0.25;
  surface.opacity = 0.5;
  scene.isosurfaces = {surface};
  expect_close(mesh, scene, 1e-3, "in faces");
  scene.isosurfaces[0].value = 0.5;  // the mesh's own sides
  expect_close(mesh, scene, 1e-3, "on the boundary");
}

TEST(MethodScenes, AnIsosurfaceThatIsOnlyTouchedIsNotDrawn) {
  // the field comes from below on both sides of a plane of faces
  ZooMesh mesh = test::structured(4, test::Cut::tetrahedra);
  test::add_node_field(mesh, "f",
                       [](const test::Position& p) { return 0.5 - std::abs(p[0] - 0.5); });
  Scene scene = test::smooth_scene(Projection::orthographic, Glow::chromaticity);
  scene.volume = {};
  Isosurface surface;
  surface.field = "f";
  surface.value = 0.5;
  scene.isosurfaces = {surface};
  EXPECT_EQ(drawn(mesh, scene, Method::exact_at_vertices).counts.surfaces, 0U);
  expect_close(mesh, scene, 0, "touched", 0);
}

TEST(MethodScenes, IsosurfacesOfOneDepthAreInTheOrderOfTheScene) {
  Scene scene = bent_scene();
  Isosurface front;
  front.field = "f";
  front.value = 0.6;
  front.color = {1, 0, 0};
  front.opacity = 0.7;
  front.specular = 0;
  Isosurface back = front;
  back.color = {0, 0, 1};
  scene.isosurfaces = {front, back};
  expect_close(fine_mesh(), scene, 1e-2, "one depth", 5e-5);
}

TEST(MethodScenes, IsosurfacesAtBreakpoints) {
  // slabs between isosurfaces are cut again where they already end
  Scene scene = bent_scene();
  scene.volume.extinction->points = {{0.2, {0.5}}, {0.45, {8}}, {0.46, {0.1}}, {0.7, {6}}};
  for (const double value : {0.2, 0.45, 0.7}) {
    Isosurface surface;
    surface.field = "f";
    surface.value = value;
    surface.opacity = 0.2;
    scene.isosurfaces.push_back(surface);
  }
  expect_close(fine_mesh(), scene, 2e-2, "at breakpoints", 5e-5);
}

TEST(MethodScenes, WithoutSlicing) {
  Scene scene = bent_scene();
  const ZooMesh mesh = fine_mesh();
  const Image truth = accurate(mesh, scene);
  const auto sliced = drawn(mesh, scene, Method::mean_color);
  scene.render.integration = Integration::approximate_unsliced;
  const auto unsliced = drawn(mesh, scene, Method::mean_color);
  EXPECT_GT(sliced.counts.slabs, 1000U);
  EXPECT_EQ(unsliced.counts.slabs, 0U);
  EXPECT_GT(errors(unsliced.image, truth).rms, 5 * errors(sliced.image, truth).rms);
  // where nothing bends, nothing is sliced
  Scene smooth = test::smooth_scene(Projection::perspective, Glow::chromaticity);
  const Image either = drawn(mesh, smooth, Method::mean_color).image;
  smooth.render.integration = Integration::approximate_unsliced;
  EXPECT_LE(errors(drawn(mesh, smooth, Method::mean_color).image, either).largest, 1e-6);
}

TEST(MethodScenes, PartsHaveTheSamePixels) {
  // cells beside a part are left out of it and nothing else changes
  const ZooMesh mesh = fine_mesh();
  for (const Projection projection : {Projection::orthographic, Projection::perspective})
    for (const Method method : {Method::mean_color, Method::exact_at_vertices}) {
      Scene scene = bent_scene();
      scene.camera.projection = projection;
      const Image whole = drawn(mesh, scene, method).image;
      const PixelRect part{37, 21, 64, 50};
      const Image image = drawn(mesh, scene, method, part).image;
      for (std::uint32_t y = 0; y < part.height; ++y)
        for (std::uint32_t x = 0; x < part.width; ++x)
          for (std::size_t c = 0; c < 4; ++c)
            ASSERT_EQ(image.at(x, y, c), whole.at(x + part.x, y + part.y, c)) << x << ' ' << y;
    }
}

}  // namespace
}  // namespace hiac::preview
