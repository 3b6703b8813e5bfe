// Pictures that could become brighter than colours may be, and fields larger than numbers may be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/frame/renderable.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac {
namespace {

using test::cube_scene;
using test::Cut;

ZooMesh bright_mesh(double value = 0.5) {
  ZooMesh mesh = test::structured(1, Cut::tetrahedra);
  mesh.fields = {Field{"f", "", FieldLocation::node, 1, std::vector<double>(8, value)}};
  return mesh;
}

std::string told_of_brightness(const Scene& scene, const ZooMesh& mesh = bright_mesh()) {
  try {
    check_renderable(mesh, scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

Scene dark_scene() { return cube_scene(Projection::perspective, 8, 8); }

TEST(TooBright, SurfacesWithTheirLights) {
  Scene scene = dark_scene();
  scene.lights = {Light{}, Light{}};
  scene.isosurfaces.resize(2);
  for (Isosurface& surface : scene.isosurfaces) {
    surface.field = "f";
    surface.color = {0.5e30, 0, 0};
    surface.ambient = 1;
    surface.diffuse = 0.5;
    surface.specular = 0;
  }
  EXPECT_EQ(told_of_brightness(scene), "");  // 0.5e30 + 2 * 0.25e30
  scene.isosurfaces[1].specular = 0.5e30;
  EXPECT_EQ(told_of_brightness(scene),
            "key `isosurface.1`: pixels may become too bright (at most 1e+30 expected, 2e+30 "
            "found)");
  scene.isosurfaces.clear();
  scene.skin.emplace();
  scene.skin->color = {0, 0, 1};
  scene.skin->ambient = 1e30;
  scene.skin->diffuse = scene.skin->specular = 0;
  EXPECT_EQ(told_of_brightness(scene), "");
  scene.skin->ambient = 3e30;
  EXPECT_EQ(told_of_brightness(scene),
            "key `skin`: pixels may become too bright (at most 1e+30 expected, 3e+30 found)");
}

TEST(TooBright, MediaThatEmitLightOverTheMeshsDiagonal) {
  Scene scene = dark_scene();
  scene.volume.color.emplace().field = "f";
  scene.volume.color->points = {{0, {0, 0, 0}}, {1, {0, 8e29, 0}}};
  scene.volume.glow = Glow::chromaticity;
  EXPECT_EQ(told_of_brightness(scene), "");
  scene.volume.glow = Glow::emission;
  EXPECT_THAT(told_of_brightness(scene),
              testing::StartsWith("key `volume.color.points`: pixels may become too bright (at "
                                  "most 1e+30 expected, 1.38"));  // times the root of 3
  scene.volume.color->points[1].value[1] = 5e29;
  EXPECT_EQ(told_of_brightness(scene), "");
}

TEST(TooBright, FieldsBeyondTheLargestNumber) {
  EXPECT_EQ(told_of_brightness(dark_scene(), bright_mesh(-1e100)), "");
  EXPECT_EQ(told_of_brightness(dark_scene(), bright_mesh(-2e100)),
            "field 'f': values are too large (at most 1e+100 in magnitude expected, 8 others "
            "found, first -2e+100)");
}

}  // namespace
}  // namespace hiac
