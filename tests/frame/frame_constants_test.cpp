#include "hiac/frame/frame_constants.hpp"

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "hiac/frame/interval_range.hpp"
#include "hiac/frame/screen_rounding.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using test::Position;

// The unit cube from the front, 3 units before it, and a field of values up to 2 and down to -5.
class FrameConstantsTest : public testing::Test {
 protected:
  FrameConstantsTest() : mesh_(test::structured(2, test::Cut::bricks)) {
    test::add_node_field(mesh_, "f", [](const Position& p) { return 2 - 7 * p[0]; });
    test::add_node_field(mesh_, "g", [](const Position& p) { return p[1] + 2 * p[0]; });
    scene_.image = {60, 40};
    scene_.camera.eye = {0.5, 0.5, 4};
    scene_.camera.look_at = {0.5, 0.5, 0};
    scene_.camera.up = {0, 1, 0};
    scene_.camera.fov = 90;
    scene_.camera.height = 2;
    scene_.volume.extinction = ExtinctionTransfer{"f", {{0, {0}}, {1, {3}}}};
    scene_.render.tolerance = 1e-6;
  }

  const Frame& frame() {
    frame_.reset();
    projector_.emplace(scene_.camera, scene_.image);
    return frame_.emplace(mesh_, scene_, *projector_);
  }

  void add_color(const std::string& field, double most) {
    scene_.volume.color = ColorTransfer{field, {{0, {0, 0, 0}}, {1, {0.1, most, 0.2}}}};
  }

  ZooMesh mesh_;
  Scene scene_;
  std::optional<Projector> projector_;
  std::optional<Frame> frame_;
};

TEST_F(FrameConstantsTest, ExtremesAreThoseOfNodesAndValues) {
  add_color("g", 1);
  const MeshExtremes extremes = extremes_of(frame());
  EXPECT_NEAR(extremes.nearest, 3, 1e-15);
  EXPECT_NEAR(extremes.farthest, 4, 1e-15);
  EXPECT_NEAR(extremes.depth(), 1, 1e-15);
  EXPECT_EQ(extremes.largest_extinction, 5);  // of -5
  EXPECT_EQ(extremes.largest_color, 3);
  add_color("f", 1);
  EXPECT_EQ(extremes_of(frame()).largest_color, 5);
}

TEST_F(FrameConstantsTest, ExtremesOfPartsAreJoined) {
  MeshExtremes all;
  EXPECT_EQ(all.depth(), 0);  // of no node
  all.add({2, 2, 0, 0});
  EXPECT_EQ(all.depth(), 0);
  all.add({1, 3, 7, 5});
  all.add({1.5, 8, 6, 9});
  all.add({});
  EXPECT_EQ(all.nearest, 1);
  EXPECT_EQ(all.farthest, 8);
  EXPECT_EQ(all.largest_color, 7);
  EXPECT_EQ(all.largest_extinction, 9);
  EXPECT_EQ(all.depth(), 7);
}

TEST_F(FrameConstantsTest, DepthsAreTheMeshs) {
  EXPECT_NEAR(frame().depth, 1, 1e-15);
  EXPECT_NEAR(frame().witness_tolerance, 1e-9, 1e-23);
  scene_.camera.projection = Projection::orthographic;
  scene_.camera.look_at = {0.5, 0.5, 100};  // from behind: depths beyond 1
  scene_.camera.eye = {0.5, 0.5, -9};
  EXPECT_NEAR(frame().depth, 1, 1e-13);
  mesh_ = test::moved(mesh_, [](const Position& p) { return Position{p[0], p[1], 4 * p[2]}; });
  EXPECT_NEAR(frame().depth, 4, 1e-13);
  EXPECT_NEAR(frame_->witness_tolerance, 4e-9, 1e-21);
}

// A ray at the border of the picture, which sees 90 degrees by 60 pixels' width to 40 pixels'
// height, is longer by the root of 1 + 1 + 1.5 squared.
TEST_F(FrameConstantsTest, ExtinctionEndsWhereTheLongestRayHasTheLargestOpticalDepth) {
  const double longest = std::sqrt(1 + 1 + 2.25);
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    scene_.camera.projection = projection;
    const double most = 1e30 / (projection == Projection::perspective ? longest : 1);
    const auto largest_extinction = [&](double wanted) {
      scene_.volume.extinction->points = {{0, {0}}, {1, {wanted}}};
      return frame().optics.extinction_function(1)[0];
    };
    EXPECT_EQ(largest_extinction(0.99 * most), 0.99 * most);
    EXPECT_NEAR(largest_extinction(1.01 * most) / most, 1, 1e-12);
    EXPECT_NEAR(largest_extinction(1e60) / most, 1, 1e-12);
  }
}

TEST_F(FrameConstantsTest, OfAMeshWithoutDepthExtinctionIsLimitedToo) {
  mesh_ = test::moved(mesh_, [](const Position& p) { return Position{p[0], p[1], 0.5}; });
  scene_.volume.extinction->points = {{0, {0}}, {1, {2e60}}};
  EXPECT_EQ(frame().depth, 0);
  EXPECT_NEAR(frame_->optics.extinction_function(1)[0] / 1e60, 1, 1e-12);
}

TEST_F(FrameConstantsTest, FieldsHaveTheIntervalsOfTheirFunctions) {
  const Frame& one = frame();  // values 2, -1.5 and -5; breakpoints 0 and 1
  ASSERT_EQ(one.extinction.intervals.size(), mesh_.node_count());
  for (NodeId node = 0; node < mesh_.node_count(); ++node) {
    const auto of = one.extinction.intervals[node];
    const int expected = mesh_.position(node)[0] == 0 ? 2 : 0;
    EXPECT_EQ(of.low, expected);
    EXPECT_EQ(of.high, expected);
  }
  EXPECT_EQ(&one.color_field(), &one.extinction);
  add_color("g", 1);
  const Frame& two = frame();
  ASSERT_EQ(two.color.intervals.size(), mesh_.node_count());
  EXPECT_EQ(&two.color_field(), &two.color);
  scene_.volume = {};
  const Frame& none = frame();
  ASSERT_EQ(none.extinction.intervals.size(), mesh_.cell_count());
  EXPECT_EQ(none.extinction.values.size(), mesh_.cell_count());
  for (const auto& of : none.extinction.intervals) EXPECT_EQ(of.low + of.high, 0);
  scene_.volume.color = ColorTransfer{"g", {{0, {0, 0, 0}}, {1, {1, 1, 1}}}};
  EXPECT_EQ(frame().extinction.intervals.size(), mesh_.node_count());
  EXPECT_EQ(frame_->extinction.values[mesh_.node_count() - 1], 3);
}

// The share of the tolerance for what is not followed is a 32nd.
TEST_F(FrameConstantsTest, RaysEndWhereNothingBehindThemShows) {
  const auto ends_at = [&](double brightest) {
    const double expected = 1e-6 / 32 / brightest;
    EXPECT_NEAR(frame().least_transparency / expected, 1, 1e-12) << brightest;
  };
  ends_at(1);
  scene_.background.color = {0.3, 0.6, 0.2};  // dimmer than 1
  ends_at(1);
  scene_.background.color = {3, 6, 5};
  ends_at(6);
  scene_.background.color2 = {0, 8, 7};
  ends_at(8);
  add_color("f", 40);
  ends_at(40);
  EXPECT_EQ(frame_->largest_light, 40);
  scene_.edges.emplace();
  scene_.edges->color = {0, 0, 50};
  ends_at(50);
  EXPECT_EQ(frame_->largest_light, 50);
  scene_.skin.emplace();
  scene_.skin->color = {60, 0, 0};
  scene_.skin->ambient = 1;
  scene_.skin->diffuse = scene_.skin->specular = 0;
  ends_at(60);
  Isosurface surface;
  surface.field = "g";
  surface.value = 0.7;
  surface.color = {0, 70, 0};
  surface.ambient = 0.5;
  surface.diffuse = 0.5;
  surface.specular = 0;
  scene_.isosurfaces = {surface};
  ends_at(70);
  EXPECT_EQ(frame_->largest_light, 70);
}

TEST_F(FrameConstantsTest, RaysThroughEmissionAreFollowedToTheEnd) {
  add_color("f", 40);
  scene_.volume.glow = Glow::emission;
  const double longest = std::sqrt(1 + 1 + 2.25);
  EXPECT_EQ(frame().least_transparency, 0);
  EXPECT_NEAR(frame_->largest_light, 40 * longest, 1e-12);
  scene_.edges.emplace();
  scene_.edges->color = {0, 0, 50};
  EXPECT_NEAR(frame().largest_light, 40 * longest + 50, 1e-12);
}

TEST_F(FrameConstantsTest, TheLongestRayIsThatOfTheCornerFarthestFromTheLineOfSight) {
  add_color("f", 40);
  scene_.volume.glow = Glow::emission;
  for (const double right : {-10.0, 10.0})
    for (const double below : {-5.0, 5.0}) {
      scene_.camera.shift = {right, below};  // 20 pixels are 1 unit: 2 across, 1.25 down
      EXPECT_NEAR(frame().largest_light, 40 * std::sqrt(1 + 4 + 1.25 * 1.25), 1e-12);
    }
}

TEST_F(FrameConstantsTest, FunctionsAreSteepForTheirFieldsAndTheLongestRay) {
  const double longest = std::sqrt(1 + 1 + 2.25);
  const auto is_steep = [&](double slope) {
    scene_.volume.extinction->points = {{0, {0}}, {1, {slope}}};
    return frame().optics.steep;
  };
  // the field's largest magnitude is 5
  EXPECT_FALSE(is_steep(0.99 * 0x1p40 / 5 / longest));
  EXPECT_TRUE(is_steep(1.01 * 0x1p40 / 5 / longest));
}

TEST(IntervalRange, IsEmptyWhereNothingAbsorbsOrEmits) {
  OpticsTables optics;
  optics.no_extinction = {1, 0, 1, 1};
  optics.no_color = {1, 1, 0};
  EXPECT_TRUE(all_zero(optics.no_extinction, {0, 0}));
  EXPECT_FALSE(all_zero(optics.no_extinction, {0, 1}));
  EXPECT_FALSE(all_zero(optics.no_extinction, {1, 2}));
  EXPECT_TRUE(all_zero(optics.no_extinction, {2, 3}));
  EXPECT_TRUE(is_empty_space(optics, {2, 2}, {2, 3}));  // without emission colour has no effect
  EXPECT_FALSE(is_empty_space(optics, {0, 1}, {1, 3}));
  optics.emission = true;
  EXPECT_FALSE(is_empty_space(optics, {1, 2}, {2, 3}));
  EXPECT_TRUE(is_empty_space(optics, {0, 1}, {2, 3}));
  EXPECT_FALSE(is_empty_space(optics, {0, 1}, {0, 3}));
}

TEST(ScreenRounding, OfCrossingsGrowsWithTheSlopeToALimit) {
  EXPECT_EQ(on_crossing(0), 0x1p-39);
  EXPECT_EQ(on_crossing(1), 0x1p-38);
  EXPECT_EQ(on_crossing(-1), 0x1p-38);
  EXPECT_EQ(on_crossing(3), 0x1p-37);
  EXPECT_EQ(on_crossing(-7), 0x1p-36);
  EXPECT_EQ(on_crossing(8), 0x1p-36);
  EXPECT_EQ(on_crossing(1e300), 0x1p-36);
}

}  // namespace
}  // namespace hiac
