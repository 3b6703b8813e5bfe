#include "hiac/scene/camera_path.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/specification.hpp"

namespace hiac {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kImage = "[image]\nwidth = 4\nheight = 3\n";
const std::string kCamera =
    "[camera]\neye = [3, 0, 1]\nlook_at = [0, 0, 1]\nup = [0, 0, 2]\nfov = 30\n";

Scene parsed(const std::string& text, const std::vector<Override>& overrides = {}) {
  return parse_scene(kImage + text, "view.toml", "", overrides).scene;
}

std::string complaint_of(const std::string& text) {
  try {
    parse_scene(text, "view.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string complaint(const std::string& text) { return complaint_of(kImage + text); }

std::string keyframe(int frame, const std::string& eye, const std::string& more = "") {
  return "[[camera]]\nframe = " + std::to_string(frame) + "\neye = " + eye + "\n" + more;
}

const std::string kRest = "look_at = [0, 0, 0]\nup = [0, 0, 1]\nfov = 30\n";

TEST(CameraPath, APlainCameraIsOneFrame) {
  const Scene scene = parsed(kCamera);
  EXPECT_FALSE(scene.path);
  EXPECT_EQ(frame_count(scene), 1U);
  EXPECT_EQ(camera_at(scene, 0), scene.camera);
}

TEST(CameraPath, KeyframesKeepWhatTheyDoNotName) {
  const Scene scene = parsed(keyframe(0, "[3, 0, 0]", kRest) + keyframe(4, "[0, 3, 0]") +
                             keyframe(10, "[0, 0.5, 3]", "fov = 40\n"));
  EXPECT_EQ(frame_count(scene), 11U);
  const auto& keyframes = std::get<KeyframePath>(*scene.path).keyframes;
  ASSERT_EQ(keyframes.size(), 3U);
  EXPECT_EQ(scene.camera, keyframes[0].camera);
  EXPECT_EQ(keyframes[1].camera.fov, 30);
  EXPECT_EQ(keyframes[2].camera.fov, 40);
  for (const Keyframe& k : keyframes) {
    EXPECT_EQ(k.camera.up, (std::array<double, 3>{0, 0, 1}));
    EXPECT_EQ(camera_at(scene, k.frame), k.camera);
  }
  EXPECT_THAT(camera_at(scene, 7).fov, DoubleNear(35, 1e-13));
  const Scene set = parsed(keyframe(0, "[3, 0, 0]", kRest) + keyframe(4, "[0, 3, 0]"),
                           {"camera.0.fov=20", "camera.1.eye=[0, 4, 0]"});
  EXPECT_EQ(camera_at(set, 4).fov, 20);
  EXPECT_EQ(camera_at(set, 4).eye[1], 4);
}

TEST(CameraPath, OneFrameStandsAlone) {
  const Scene scene = parsed(keyframe(0, "[3, 0, 0]", kRest) + keyframe(4, "[0, 3, 0]"));
  const Scene one = scene_of_frame(scene, 3);
  EXPECT_FALSE(one.path);
  EXPECT_EQ(one.camera, camera_at(scene, 3));
  EXPECT_EQ(one.image, scene.image);
}

TEST(CameraPath, LinesAreStraightAndEven) {
  const Scene scene =
      parsed(keyframe(0, "[3, 0, 0]", kRest) + keyframe(8, "[3, 8, 4]", "look_at = [0, 4, 0]\n") +
             keyframe(10, "[9, 0, 0]") + "[camera_path]\ninterpolation = \"linear\"\n");
  for (std::uint32_t f = 0; f <= 8; ++f) {
    const Camera camera = camera_at(scene, f);
    EXPECT_THAT(camera.eye, ElementsAre(3, DoubleNear(f, 1e-14), DoubleNear(f / 2.0, 1e-14)));
    EXPECT_THAT(camera.look_at, ElementsAre(0, DoubleNear(f / 2.0, 1e-14), 0));
  }
  EXPECT_THAT(camera_at(scene, 9).eye, ElementsAre(6, 4, 2));
}

// The basis matrix that the spline is commonly written with, for even frames.
double catmull_rom(double p0, double p1, double p2, double p3, double s) {
  return 0.5 * (2 * p1 + (p2 - p0) * s + (2 * p0 - 5 * p1 + 4 * p2 - p3) * s * s +
                (-p0 + 3 * p1 - 3 * p2 + p3) * s * s * s);
}

TEST(CameraPath, InnerPiecesAreCatmullRoms) {
  const std::array<double, 5> y{0, 3, -1, 4, 2};
  std::string text;
  for (int k = 0; k < 5; ++k)
    text += keyframe(10 * k, "[9, " + std::to_string(y[static_cast<std::size_t>(k)]) + ", 0]",
                     k == 0 ? kRest : "");
  const Scene scene = parsed(text);
  for (std::uint32_t f = 10; f <= 30; ++f) {
    const std::size_t at = f == 30 ? 2 : f / 10;
    const double expected =
        catmull_rom(y[at - 1], y[at], y[at + 1], y[at + 2], f / 10.0 - static_cast<double>(at));
    EXPECT_THAT(camera_at(scene, f).eye[1], DoubleNear(expected, 1e-13)) << f;
  }
}

TEST(CameraPath, UnevenFramesKeepASteadyVelocity) {
  const Scene scene = parsed(keyframe(0, "[9, 0, 0]", kRest) + keyframe(3, "[9, 3, 0]") +
                             keyframe(50, "[9, 50, 0]") + keyframe(51, "[9, 51, 0]"));
  for (std::uint32_t f = 0; f < 52; ++f)
    EXPECT_THAT(camera_at(scene, f).eye[1], DoubleNear(f, 1e-12));
}

TEST(CameraPath, WhatStandsStillDoesSoToTheLastBit) {
  const Scene scene =
      parsed(keyframe(0, "[2.3, 1.9, 1.4]", kRest) + keyframe(7, "[2.3, 1.9, 1.4]"));
  for (std::uint32_t f = 0; f < 8; ++f) EXPECT_EQ(camera_at(scene, f).eye, scene.camera.eye);
}

TEST(CameraPath, ClippingSlabsMayBeEndless) {
  const Scene scene = parsed(keyframe(0, "[9, 0, 0]", kRest + "clip = [1, inf]\n") +
                             keyframe(4, "[9, 1, 0]", "clip = [3, inf]\n"));
  const auto clip = *camera_at(scene, 2).clip;
  EXPECT_EQ(clip[0], 2);
  EXPECT_EQ(clip[1], std::numeric_limits<double>::infinity());
}

TEST(CameraPath, AnEndlessSlabEndsAtAKeyframe) {
  const double endless = std::numeric_limits<double>::infinity();
  for (const bool ends : {true, false}) {
    const std::string first = ends ? "clip = [0, inf]\n" : "clip = [0, 5]\n";
    const std::string last = ends ? "clip = [0, 5]\n" : "clip = [2, inf]\n";
    const Scene scene =
        parsed(keyframe(0, "[9, 0, 0]", kRest + first) + keyframe(4, "[9, 1, 0]", last));
    const double near = ends ? 0 : 2;
    EXPECT_THAT(*camera_at(scene, 0).clip, ElementsAre(0, ends ? endless : 5));
    for (const std::uint32_t f : {1U, 2U, 3U})
      EXPECT_THAT(*camera_at(scene, f).clip, ElementsAre(near * f / 4, endless)) << f;
    EXPECT_THAT(*camera_at(scene, 4).clip, ElementsAre(near, ends ? 5 : endless));
  }
}

TEST(CameraPath, HeightsOfParallelViewsRunEvenly) {
  const std::string rest =
      "look_at = [0, 0, 0]\nup = [0, 0, 1]\nprojection = \"orthographic\"\nheight = 2\n";
  const Scene scene = parsed(keyframe(0, "[3, 0, 0]", rest) + keyframe(4, "[3, 0, 1]") +
                             keyframe(8, "[3, 0, 1]", "height = 10\n"));
  const std::array<double, 9> heights{2, 2, 2, 2, 2, 4, 6, 8, 10};
  for (std::uint32_t f = 0; f <= 8; ++f) {
    const Camera camera = camera_at(scene, f);
    EXPECT_EQ(camera.projection, Projection::orthographic);
    EXPECT_EQ(camera.height, heights[f]) << f;
  }
}

TEST(CameraPath, ATurntableGoesRoundItsMiddle) {
  const Scene scene = parsed(kCamera + "[turntable]\nframes = 8\n");
  EXPECT_EQ(frame_count(scene), 8U);
  EXPECT_EQ(camera_at(scene, 0), scene.camera);
  for (std::uint32_t f = 0; f < 8; ++f) {
    const Camera camera = camera_at(scene, f);
    const double angle = f * std::numbers::pi / 4;
    EXPECT_THAT(camera.eye, ElementsAre(DoubleNear(3 * std::cos(angle), 1e-14),
                                        DoubleNear(3 * std::sin(angle), 1e-14), 1));
    EXPECT_EQ(camera.look_at, scene.camera.look_at);
    EXPECT_THAT(camera.up, ElementsAre(0, 0, DoubleNear(2, 1e-15)));
  }
  EXPECT_EQ(camera_at(scene, 2).eye, (std::array<double, 3>{0, 3, 1}));
  EXPECT_EQ(camera_at(scene, 4).eye, (std::array<double, 3>{-3, 0, 1}));
  EXPECT_EQ(camera_at(scene, 6).eye, (std::array<double, 3>{0, -3, 1}));
}

TEST(CameraPath, ATurntableTurnsUpAboutAnyAxis) {
  const Scene scene =
      parsed(kCamera + "[turntable]\nframes = 3\ndegrees = -270\naxis = [0, 2, 0]\n");
  const Camera camera = camera_at(scene, 1);  // by -90 about y: x goes to z, z to -x
  EXPECT_EQ(camera.eye, (std::array<double, 3>{0, 0, 4}));
  EXPECT_EQ(camera.up, (std::array<double, 3>{-2, 0, 0}));
}

TEST(CameraPath, ImpossiblePathsAreRefusedByName) {
  const std::string first = keyframe(0, "[3, 0, 0]", kRest);
  EXPECT_THAT(complaint(keyframe(1, "[3, 0, 0]", kRest)), HasSubstr("first keyframe must be at 0"));
  EXPECT_THAT(complaint(first + keyframe(0, "[4, 0, 0]")), HasSubstr("frames must ascend"));
  EXPECT_THAT(complaint(first + "[[camera]]\neye = [1, 2, 3]\n"),
              HasSubstr("view.toml:10: key `camera.1.frame`: is missing"));
  EXPECT_THAT(complaint(first + keyframe(9, "[4, 0, 0]", "look = 3\n")),
              HasSubstr("`camera.1.look`: unknown key"));
  for (const char* height : {"", "height = 3\n"})
    EXPECT_THAT(
        complaint(first + keyframe(9, "[4, 0, 0]",
                                   std::string("projection = \"orthographic\"\n") + height)),
        HasSubstr("view.toml:13: key `camera.1.projection`: must be that of the first"));
  EXPECT_THAT(complaint(first + keyframe(9, "[4, 0, 0]", "clip = [1, 2]\n")),
              HasSubstr("`camera.1.clip`: is missing in the first"));
  EXPECT_THAT(complaint(first + keyframe(200000, "[4, 0, 0]")), HasSubstr("camera.1.frame"));
  EXPECT_THAT(complaint(first + "[turntable]\nframes = 3\n"), HasSubstr("`turntable`"));
  EXPECT_THAT(complaint(kCamera + "[camera_path]\n"), HasSubstr("`camera_path`"));
  EXPECT_THAT(complaint(kCamera + "frame = 3\n"), HasSubstr("unknown key"));
  EXPECT_THAT(complaint(kCamera + "[turntable]\n"), HasSubstr("`turntable.frames`: is missing"));
  EXPECT_THAT(complaint(kCamera + "[turntable]\nframes = 3\ndegrees = 0\n"),
              HasSubstr("other than 0"));
  EXPECT_THAT(complaint(kCamera + "[turntable]\nframes = 3\naxis = [0, 0, 0]\n"),
              HasSubstr("cannot be zero"));
  for (const auto& [list, what] : {std::pair{"[]", "at least one keyframe"}, {"[1]", "a table"}})
    EXPECT_THAT(complaint_of("camera = " + std::string(list) + "\n" + kImage), HasSubstr(what));
}

// From one side of look_at to the other by a straight line, through it.
TEST(CameraPath, AFrameWithoutAViewIsRefused) {
  EXPECT_THAT(complaint(keyframe(0, "[3, 0, 0]", kRest) + keyframe(2, "[-3, 0, 0]")),
              HasSubstr("no view at frame 1: its `look_at` is the same point as `eye`"));
  EXPECT_THAT(
      complaint(keyframe(0, "[3, 0, 0]", kRest) + keyframe(2, "[3, 0, 1]", "up = [0, 0, -1]\n")),
      HasSubstr("no view at frame 1: its `up`"));
}

}  // namespace
}  // namespace hiac
