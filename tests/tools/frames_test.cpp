#include "tools/common/picture/frames.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"

namespace hiac::tools {
namespace {

TEST(Frames, NamesGetTheirNumber) {
  EXPECT_EQ(frame_path("out.png", 7), "out-0007.png");
  EXPECT_EQ(frame_path("out.png", 12345), "out-12345.png");
  EXPECT_EQ(frame_path("a.b/out.v2.exr", 0), "a.b/out.v2-0000.exr");
  EXPECT_EQ(frame_path("out-%04d.png", 7), "out-0007.png");
  EXPECT_EQ(frame_path("%d/out.png", 7), "7/out.png");
  EXPECT_EQ(frame_path("out%02d.png", 123), "out123.png");
  EXPECT_EQ(frame_path("100%.png", 3), "100%-0003.png");
  EXPECT_EQ(frame_path("%s%x%9999d.png", 3), "%s%x%9999d-0003.png");
  EXPECT_THROW(frame_path("%d-%d.png", 3), UsageError);
  EXPECT_TRUE(has_frame_number("x%03d.png"));
  EXPECT_FALSE(has_frame_number("x%.png"));
}

TEST(Frames, AreChosenOfAPath) {
  Scene scene;
  EXPECT_EQ(chosen_frames(scene, {}), std::vector<std::uint32_t>{0});
  EXPECT_THROW(chosen_frames(scene, 0), UsageError);
  scene.path = Turntable{3, 360, {}};
  EXPECT_EQ(chosen_frames(scene, {}), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(chosen_frames(scene, 2), std::vector<std::uint32_t>{2});
  EXPECT_THROW(chosen_frames(scene, 3), UsageError);
}

}  // namespace
}  // namespace hiac::tools
