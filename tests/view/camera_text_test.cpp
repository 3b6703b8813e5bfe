#include "tools/view/document/camera_text.hpp"

#include <random>
#include <string>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/camera_motion.hpp"
#include "hiac/scene/specification.hpp"

namespace hiac::view {
namespace {

const std::string kText = R"(# a view
[image]
width = 80
height = 60
[camera]  # where from
eye = [0.0, -3.0, 1.0]  # near
look_at = [0.0, 0.0, 0.0]
up = [0, 0, 1]
fov = 30.0
[background]
color = [1, 1, 1]  # white
)";

const std::string kPath = R"([image]
width = 80
height = 60
[[camera]]
frame = 0
eye = [0.0, -3.0, 1.0]
look_at = [0.0, 0.0, 0.0]
up = [0, 0, 1]
fov = 30.0
[[camera]]  # the second
frame = 20
eye = [1.0, -3.0, 1.0]
[[camera]]
frame = 30
fov = 20.0
)";

Scene scene_of(const std::string& text) { return parse_scene(text, "text").scene; }

Camera some_camera(std::mt19937_64& random) {
  std::uniform_real_distribution<double> number(-4, 4);
  Camera camera{Projection::perspective, {}, {}, {0.1, 0.2, 1}, 25 + number(random), 0, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    camera.eye[c] = number(random);
    camera.look_at[c] = number(random);
  }
  return camera;
}

TEST(CameraText, HasTheCameraToTheBitAndKeepsAllElse) {
  std::mt19937_64 random(1);
  std::string text = kText;
  for (int k = 0; k < 50; ++k) {
    const Camera camera = k % 5 == 4
                              ? with_projection(scene_of(text).camera, Projection::orthographic, 30)
                              : some_camera(random);
    text = with_camera(text, scene_of(text), 0, camera);
    Scene expected = scene_of(kText);
    expected.camera = camera;
    EXPECT_EQ(scene_of(text), expected);
    for (const char* comment : {"# a view", "# where from", "# near", "# white"})
      EXPECT_NE(text.find(comment), std::string::npos) << comment;
  }
}

TEST(CameraText, ChangesOneKeyframeAlone) {
  std::mt19937_64 random(2);
  const Scene before = scene_of(kPath);
  for (std::size_t k = 0; k < 3; ++k) {
    const Camera camera = some_camera(random);
    Scene expected = before;
    std::get<KeyframePath>(*expected.path).keyframes[k].camera = camera;
    if (k == 0) expected.camera = camera;
    EXPECT_EQ(scene_of(with_camera(kPath, before, k, camera)), expected) << k;
  }
}

TEST(CameraText, FindsTheKeyframeOfAFrame) {
  EXPECT_EQ(keyframe_at(scene_of(kText), 0), 0U);
  EXPECT_EQ(keyframe_at(scene_of(kPath), 20), 1U);
  EXPECT_EQ(keyframe_at(scene_of(kPath), 21), std::nullopt);
  const Scene turning = scene_of(kText + "[turntable]\nframes = 8\n");
  EXPECT_EQ(keyframe_at(turning, 0), 0U);
  EXPECT_EQ(keyframe_at(turning, 1), std::nullopt);
}

TEST(CameraText, RecordsKeyframesAnywhere) {
  std::mt19937_64 random(3);
  std::string text = kText;
  KeyframePath expected;
  expected.keyframes.push_back({0, scene_of(kText).camera});
  for (const std::uint32_t frame : {20U, 40U, 10U, 30U, 20U, 0U}) {
    const Camera camera = some_camera(random);
    text = with_keyframe(text, scene_of(text), frame, camera);
    auto& keyframes = expected.keyframes;
    std::erase_if(keyframes, [&](const Keyframe& k) { return k.frame == frame; });
    keyframes.push_back({frame, camera});
    std::ranges::sort(keyframes, {}, &Keyframe::frame);
    EXPECT_EQ(std::get<KeyframePath>(*scene_of(text).path), expected) << text;
    EXPECT_NE(text.find("# near"), std::string::npos);
  }
}

TEST(CameraText, RefusesKeyframesWhereThereCanBeNone) {
  const Scene scene = scene_of(kText);
  EXPECT_THROW(with_keyframe(kText, scene, 0, scene.camera), UsageError);
  const std::string turning = kText + "[turntable]\nframes = 8\n";
  EXPECT_THROW(with_keyframe(turning, scene_of(turning), 3, scene.camera), UsageError);
}

TEST(CameraText, SaysWhyThereCanBeNoKeyframe) {
  const auto told = [](const std::string& text, std::uint32_t frame) -> std::string {
    try {
      const Scene scene = scene_of(text);
      static_cast<void>(with_keyframe(text, scene, frame, scene.camera));
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(told(kText, 0), "keyframe: frame 0 is the present camera (a frame from 1 expected)");
  EXPECT_EQ(told(kText, 1), "");
  for (const std::uint32_t frame : {0U, 3U, 8U})
    EXPECT_EQ(told(kText + "[turntable]\nframes = 8\n", frame),
              "keyframe: the path is a turntable, which has none");
}

}  // namespace
}  // namespace hiac::view
