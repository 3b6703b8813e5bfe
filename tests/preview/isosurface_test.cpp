#include <cmath>
#include <string>

#include "tests/preview/preview_support.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using test::benchmark_scene;

class IsosurfacePreview : public test::WithDriver {
 protected:
  static Scene scene_of(Projection projection) {
    Scene scene = benchmark_scene(projection, 120, 90);
    const Isosurface one{.field = "g", .value = 0.35, .color = {1, 0.5, 0.2}, .opacity = 0.6};
    const Isosurface two{
        .field = "f", .value = 0.43, .color = {0.2, 0.6, 1}, .opacity = 0.4, .specular = 0};
    scene.isosurfaces = {one, two};
    scene.lights = {Light{}, Light{std::array<double, 3>{1, 2, 3}, {0.5, 0.4, 0.3}}};
    return scene;
  }
};

TEST_F(IsosurfacePreview, LitSurfacesAtTheirDepth) {
  const ZooMesh mesh = test::delaunay_with_fields(150, 11);
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    Scene scene = scene_of(projection);
    expect_close(mesh, scene, 2e-5, 1e-6);
    scene.camera.clip = {{3.4, 3.9}};
    expect_close(mesh, scene, 2e-5, 1e-6);
  }
}

// A high power of a cosine near 1 needs more digits than single precision has.
TEST_F(IsosurfacePreview, SharpHighlights) {
  const ZooMesh mesh = test::delaunay_with_fields(150, 11);
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    Scene scene = scene_of(projection);
    for (Isosurface& surface : scene.isosurfaces) {
      surface.opacity = 1;
      surface.specular = 0.8;
      surface.shininess = 300;
    }
    expect_close(mesh, scene, 2e-6, 1e-6);
  }
}

// Every face x = 1/2 of the lattice has the surface's value: it is drawn once, also edge-on.
TEST_F(IsosurfacePreview, SurfacesInFacesAreDrawnOnce) {
  ZooMesh mesh = test::lattice_with_fields(4);
  test::add_node_field(mesh, "x", [](const test::Position& p) { return p[0]; });
  for (const Projection projection : {Projection::orthographic, Projection::perspective})
    for (const test::Position& eye :
         {test::Position{3.1, 2.3, 2.7}, {-2.1, 0.3, 0.2}, {3.5, 0.5, 0.5}, {0.5, 3.5, 0.5}}) {
      Scene scene = scene_of(projection);
      scene.isosurfaces[0].field = "x";
      scene.isosurfaces[0].value = 0.5;
      scene.camera.eye = eye;
      expect_close(mesh, scene, 2e-5, 1e-6);
    }
}

// A field that only touches the value from below has no surface there.
TEST_F(IsosurfacePreview, TouchedFacesAreClosed) {
  ZooMesh mesh = test::lattice_with_fields(4);
  test::add_node_field(mesh, "tent",
                       [](const test::Position& p) { return 0.5 - std::abs(p[0] - 0.5); });
  Scene scene = scene_of(Projection::perspective);
  scene.isosurfaces[0].field = "tent";
  scene.isosurfaces[0].value = 0.5;
  expect_close(mesh, scene, 2e-5, 1e-6);
}

// Nested surfaces by the dozen, of two fields in turn, some of them of one value.
TEST_F(IsosurfacePreview, AnyNumberOfSurfaces) {
  const ZooMesh mesh = test::delaunay_with_fields(60, 13);
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    Scene scene = scene_of(projection);
    const Isosurface one = scene.isosurfaces[0], two = scene.isosurfaces[1];
    for (int k = 0; k < 60; ++k) {
      Isosurface surface = k % 2 == 0 ? one : two;
      surface.value = 0.05 + 0.9 * ((k * 37) % 50) / 50.0;
      surface.opacity = 0.05 + 0.1 * (k % 3);
      surface.color = {0.2 + 0.1 * (k % 7), 0.9 - 0.1 * (k % 5), 0.5};
      scene.isosurfaces.push_back(surface);
    }
    expect_close(mesh, scene, 2e-5, 1e-6);
  }
}

// More fields than a driver hands from the vertices of a cell to its pixels.
TEST_F(IsosurfacePreview, SurfacesOfManyFields) {
  ZooMesh mesh = test::lattice_with_fields(3);
  Scene scene = scene_of(Projection::perspective);
  const Isosurface one = scene.isosurfaces[0];
  for (int k = 0; k < 11; ++k) {
    Isosurface surface = one;
    surface.field = "s" + std::to_string(k);
    surface.value = 0.3 + 0.05 * k;
    surface.opacity = 0.2;
    surface.color = {0.1 * k, 0.5, 1 - 0.1 * k};
    test::add_node_field(mesh, surface.field, [k](const test::Position& p) {
      return std::abs(p[static_cast<std::size_t>(k) % 3] - 0.07 * k) + 0.05 * p[0];
    });
    scene.isosurfaces.push_back(surface);
  }
  // and some that lie in faces, where they are closed
  for (int k = 0; k < 3; ++k) {
    Isosurface surface = one;
    surface.field = "t" + std::to_string(k);
    surface.value = 0.5;
    test::add_node_field(mesh, surface.field, [k](const test::Position& p) {
      return 0.5 - std::abs(p[static_cast<std::size_t>(k)] - 1.0 / 3);
    });
    scene.isosurfaces.push_back(surface);
  }
  expect_close(mesh, scene, 2e-5, 1e-6);
}

}  // namespace
}  // namespace hiac
