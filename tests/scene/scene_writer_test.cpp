#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/scene/specification.hpp"

namespace hiac {
namespace {

Scene round_trip(const Scene& scene, Comments comments) {
  return parse_scene(to_toml(scene, comments), "text").scene;
}

/// A scene with every part, of numbers that need all their digits.
Scene random_scene(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto wide = [&] { return (unit(random) - 0.5) * std::pow(10, 20 * unit(random) - 10); };
  const auto color = [&] { return Color{unit(random), unit(random), unit(random)}; };
  Scene s;
  s.image = {1 + static_cast<std::uint32_t>(random() % 4000), 7};
  const double scale = std::pow(10, 20 * unit(random) - 10);
  s.camera.eye = {scale * unit(random), 0, scale * unit(random)};
  s.camera.look_at = {0, scale, scale * unit(random)};
  s.camera.up = {0, unit(random), wide()};
  s.camera.projection = random() % 2 == 0 ? Projection::perspective : Projection::orthographic;
  (s.camera.projection == Projection::perspective ? s.camera.fov : s.camera.height) =
      1 + 100 * unit(random);
  if (random() % 2 == 0) s.camera.clip = {unit(random), 1 + unit(random)};
  s.volume.glow = random() % 2 == 0 ? Glow::chromaticity : Glow::emission;
  s.volume.color = ColorTransfer{"a \"b\"\\\t\x01\x7f é", {{-1e-300, color()}, {5e-324, color()}}};
  s.volume.extinction = ExtinctionTransfer{"b", {{-2, {1e300}}, {-2, {0}}, {1.0 / 3, {4}}}};
  s.isosurfaces = {{"p", wide(), color(), unit(random), unit(random), 0.1, 0.2, 1e6}, {"q", 0}};
  if (random() % 3 > 0)
    s.skin =
        Skin{color(), {}, unit(random), unit(random), unit(random), unit(random), std::abs(wide())};
  if (s.skin && random() % 2 == 0)
    s.skin = Skin{{0.7, 0.7, 0.7}, ColorTransfer{"s", {{-1, color()}, {2, color()}}}, unit(random)};
  if (random() % 2 == 0) {
    s.edges =
        Edges{static_cast<EdgeChoice>(random() % 3), 30, 1 + unit(random), color(), unit(random)};
    if (s.edges->show == EdgeChoice::feature) s.edges->angle = 180 * unit(random);
  }
  s.lights = {Light{}, Light{std::array<double, 3>{wide(), 1, 0}, color()}};
  s.background.pattern = static_cast<BackgroundPattern>(random() % 4);
  s.background.color = color();
  if (s.background.pattern != BackgroundPattern::solid) s.background.color2 = color();
  s.render = {static_cast<Integration>(random() % 4), static_cast<Interpolation>(random() % 2),
              unit(random), 12, unit(random)};
  return s;
}

TEST(SceneWriter, ItsTextGivesTheSceneBack) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const Scene scene = random_scene(random);
    EXPECT_EQ(round_trip(scene, Comments::none), scene) << to_toml(scene);
    EXPECT_EQ(round_trip(scene, Comments::explain), scene) << to_toml(scene, Comments::explain);
  }
}

TEST(SceneWriter, KeepsThePathOfTheCamera) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 100; ++trial) {
    Scene scene = random_scene(random);
    if (trial % 2 == 0) {
      Turntable table{1 + static_cast<std::uint32_t>(random() % 50), normal(random), {}};
      if (trial % 4 == 0) table.axis = {normal(random), 1, normal(random)};
      scene.path = table;
    } else {
      KeyframePath path;
      path.interpolation = static_cast<PathInterpolation>(random() % 2);
      for (std::uint32_t k = 0; k < 4; ++k) {
        path.keyframes.push_back({k * k * 7, scene.camera});
        path.keyframes.back().camera.up[0] = normal(random) * scene.camera.up[2];
      }
      scene.camera = path.keyframes[0].camera;
      scene.path = path;
    }
    EXPECT_EQ(round_trip(scene, Comments::none), scene) << to_toml(scene);
    EXPECT_EQ(round_trip(scene, Comments::explain), scene) << to_toml(scene, Comments::explain);
  }
}

TEST(SceneWriter, KeepsAnInfiniteFarPlaneAndTheLeastScene) {
  Scene scene;
  scene.image = {1, 1};
  scene.camera = {Projection::perspective,
                  {1, 0, 0},
                  {0, 0, 0},
                  {0, 0, 1},
                  90,
                  0,
                  std::array<double, 2>{0, std::numeric_limits<double>::infinity()}};
  EXPECT_EQ(round_trip(scene, Comments::none), scene);
}

TEST(SceneWriter, ExplainsEveryKey) {
  std::mt19937 random(2);
  const std::string text = to_toml(random_scene(random), Comments::explain);
  for (const char* words : {"# pixels", "preset =", "# world units", "planarity"})
    EXPECT_THAT(text, testing::HasSubstr(words));
}

}  // namespace
}  // namespace hiac
