#include "tests/preview/preview_support.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using test::cube_scene;

class IsosurfacePreview : public test::WithDriver {
 protected:
  static Scene scene_of(Projection projection) {
    Scene scene = cube_scene(projection, 120, 90);
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

TEST_F(IsosurfacePreview, TooManyAreRefused) {
  const ZooMesh mesh = test::lattice_with_fields(2);
  Scene scene = scene_of(Projection::perspective);
  scene.isosurfaces.resize(9, scene.isosurfaces[0]);
  EXPECT_THROW(preview::Preview(context(), mesh, scene), UsageError);
}

}  // namespace
}  // namespace hiac
