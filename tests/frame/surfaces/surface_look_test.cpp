#include "hiac/frame/surfaces/surface_look.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "hiac/frame/surfaces/skin.hpp"

namespace hiac {
namespace {

using Direction = std::array<double, 3>;

Isosurface colorful_surface() {
  Isosurface surface;
  surface.color = {0.1, 0.2, 0.4};
  surface.opacity = 0.25;
  surface.ambient = 0.5;
  surface.diffuse = 0.6;
  surface.specular = 0.7;
  surface.shininess = 11;
  return surface;
}

Skin colorful_skin() {
  Skin skin;
  skin.color = {0.1, 0.2, 0.4};
  skin.opacity = 0.25;
  skin.ambient = 0.5;
  skin.diffuse = 0.6;
  skin.specular = 0.7;
  skin.shininess = 11;
  return skin;
}

TEST(SurfaceLook, IsWhatTheSceneSays) {
  for (const SurfaceLook& look : {look_of(colorful_surface()), look_of(colorful_skin())}) {
    EXPECT_EQ(look.color, (Color{0.1, 0.2, 0.4}));
    EXPECT_DOUBLE_EQ(look.log_transparency, std::log(0.75));
    EXPECT_EQ(look.ambient, 0.5);
    EXPECT_EQ(look.diffuse, 0.6);
    EXPECT_EQ(look.specular, 0.7);
    EXPECT_EQ(look.shininess, 11);
  }
  Isosurface opaque;
  EXPECT_EQ(look_of(opaque).log_transparency, -INFINITY);
}

// Every light at its largest share: that of the channel that becomes the brightest.
TEST(SurfaceLook, LightIsTheAmbientShareAndThatOfEveryLight) {
  const SurfaceLook look = look_of(colorful_surface());
  EXPECT_DOUBLE_EQ(largest_light(look, {}), 0.5 * 0.4);
  const std::vector<Light> one{{{}, {1, 1, 1}}};
  EXPECT_DOUBLE_EQ(largest_light(look, one), 0.2 + 0.6 * 0.4 + 0.7);
  const std::vector<Light> two{{{}, {1, 1, 1}}, {Direction{0, 0, 1}, {3, 0, 0}}};
  EXPECT_DOUBLE_EQ(largest_light(look, two), 0.05 + 4 * (0.6 * 0.1 + 0.7));
}

TEST(SurfaceLook, LightOfASkinIsThatOfItsBrightestColors) {
  Skin skin = colorful_skin();
  const std::vector<Light> one{{{}, {1, 2, 1}}};
  EXPECT_DOUBLE_EQ(largest_light(skin, one), 0.5 * 0.2 + 2 * (0.6 * 0.2 + 0.7));
  skin.color = {5, 5, 5};  // replaced
  skin.color_by = ColorTransfer{"f", {{0, {0.3, 0, 0.9}}, {1, {0.2, 0.5, 0}}, {2, {0, 0.4, 0}}}};
  EXPECT_DOUBLE_EQ(largest_light(skin, one), 0.5 * 0.5 + 2 * (0.6 * 0.5 + 0.7));
  EXPECT_DOUBLE_EQ(largest_light(skin, {}), 0.5 * 0.9);
}

// The camera looks along -y, so that x points to the left and z up.
TEST(FrameLights, PointToTheLightInTheCamerasFrame) {
  Camera camera;
  camera.eye = {0, 5, 0};
  camera.up = {0, 0, 1};
  camera.fov = 40;
  const Projector projector(camera, {4, 4});
  std::vector<Light> lights{{{}, {1, 0, 2}}};
  for (const double scale : {1.0, 1e-320, 1e-200, 1.45e307})
    lights.push_back({Direction{-3 * scale, -12 * scale, 4 * scale}, {0.5, 1, 0}});
  lights.push_back({Direction{0, 0, -7}, {}});
  lights.push_back({Direction{2, 0, 0}, {}});
  const std::vector<FrameLight> found = frame_lights(lights, projector);
  ASSERT_EQ(found.size(), lights.size());
  EXPECT_TRUE(found[0].headlight);
  EXPECT_EQ(found[0].color, (Color{1, 0, 2}));
  for (std::size_t k = 1; k <= 4; ++k) {
    EXPECT_FALSE(found[k].headlight);
    EXPECT_EQ(found[k].color, (Color{0.5, 1, 0}));
    const double accuracy = k == 2 ? 1e-3 : 1e-15;  // digits of denormal numbers
    EXPECT_NEAR(found[k].direction[0], 3 / 13.0, accuracy) << k;
    EXPECT_NEAR(found[k].direction[1], 4 / 13.0, accuracy) << k;
    EXPECT_NEAR(found[k].direction[2], 12 / 13.0, accuracy) << k;
  }
  EXPECT_EQ(found[5].direction, (Direction{0, -1, 0}));
  EXPECT_EQ(found[6].direction, (Direction{-1, 0, 0}));
}

}  // namespace
}  // namespace hiac
