#include "hiac/render/cells/cell_segments.hpp"

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/render/truth/general_meshes.hpp"

namespace hiac {
namespace {

// Runs of all lengths over a tile whose pixels are partly opaque already, between clipping planes
// that cut some segments off, and shorten some.
class CellSegmentsTest : public testing::Test {
 protected:
  CellSegmentsTest()
      : mesh_(test::structured(1, test::Cut::bricks)),
        scene_(make_scene()),
        projector_(scene_.camera, scene_.image) {
    test::add_node_field(mesh_, "f", [](const test::Position& p) { return p[0]; });
    frame_ = std::make_unique<Frame>(mesh_, scene_, projector_);
    frame_->least_transparency = 0.1;
    frame_->witness_tolerance = 0.01;
    fill(buffer_->red), fill(buffer_->green), fill(buffer_->blue), fill(buffer_->ray_scale);
    fill(buffer_->transparency), fill(buffer_->last);
    for (double& last : buffer_->last) last += 1;
    for (int y = kTile.y0; y < kTile.y1; ++y) {
      const int count = y - kTile.y0 + 1, x = kTile.x0 + (y % 2) * (kTile.x1 - kTile.x0 - count);
      runs_.runs.push_back({x, y, runs_.count, static_cast<std::size_t>(count)});
      runs_.count += static_cast<std::size_t>(count);
    }
    for (std::size_t k = 0; k < runs_.count; ++k) {
      runs_.front.push_back(1 + number());
      runs_.back.push_back(runs_.front.back() + 0.3 * number());
    }
    runs_.front.resize(runs_.count + 8);
    runs_.back.resize(runs_.count + 8);
  }

  static Scene make_scene() {
    Scene scene = test::cube_scene(Projection::perspective, 40, 40);
    scene.camera.clip = {1.1, 1.9};
    return scene;
  }

  double number() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  void fill(TileBuffer::Plane& plane) {
    for (double& value : plane) value = number();
  }

  TileTarget target(SegmentList* group) { return {*frame_, kTile, *buffer_, group, counts_}; }

  static constexpr TileRect kTile{3, 5, 33, 33};
  std::mt19937 random_{7};
  ZooMesh mesh_;
  Scene scene_;
  Projector projector_;
  std::unique_ptr<Frame> frame_;
  std::unique_ptr<TileBuffer> buffer_ = std::make_unique<TileBuffer>();
  TileCounts counts_;
  CrossingRuns runs_;
  CellSegments segments_;
};

TEST_F(CellSegmentsTest, AreThoseOfRunsThatAreSeen) {
  SegmentList group;
  for (const bool by_visibility : {false, true}) {
    segments_.start(runs_.count, false);
    collect_runs(target(by_visibility ? nullptr : &group), runs_, 1e-6, segments_);
    std::size_t k = 0;
    for (const auto& [x, y, first, count] : runs_.runs)
      for (std::size_t i = 0; i < count; ++i) {
        const int column = x + static_cast<int>(i);
        const std::size_t at = kTile.index(column, y);
        const double front = std::max(runs_.front[first + i], projector_.near());
        const double back = std::min(runs_.back[first + i], projector_.far());
        const double seen = buffer_->transparency[at];
        if (seen <= 0.1 || front >= back) continue;
        ASSERT_LT(k, segments_.count);
        EXPECT_EQ(segments_.at[k], at);
        EXPECT_EQ(segments_.x[k], column + 0.5);
        EXPECT_EQ(segments_.y[k], y + 0.5);
        EXPECT_EQ(segments_.front[k], front);
        EXPECT_EQ(segments_.back[k], back);
        EXPECT_DOUBLE_EQ(segments_.length[k], (back - front) * buffer_->ray_scale[at]);
        EXPECT_DOUBLE_EQ(segments_.allowed[k], 1e-6 * (back - front) / (by_visibility ? seen : 1));
        ++k;
      }
    EXPECT_EQ(segments_.count, k);
    EXPECT_GT(k, 100U);
    EXPECT_LT(k, runs_.count - 50);
  }
}

TEST_F(CellSegmentsTest, AreCompositedWhereTheyAreDone) {
  segments_.start(runs_.count, false);
  collect_runs(target(nullptr), runs_, 1e-6, segments_);
  const auto before = std::make_unique<TileBuffer>(*buffer_);
  const auto expected = std::make_unique<TileBuffer>(*buffer_);
  std::uint64_t violations = 0;
  for (std::size_t k = 0; k < segments_.count; ++k) {
    segments_.red[k] = number();
    segments_.green[k] = number();
    segments_.blue[k] = number();
    segments_.transparency[k] = number();
    segments_.done[k] = number() < 0.95 ? 1 : 0;
    if (segments_.done[k] == 0) continue;
    const std::size_t at = segments_.at[k];
    const double seen = before->transparency[at];
    expected->red[at] += seen * segments_.red[k];
    expected->green[at] += seen * segments_.green[k];
    expected->blue[at] += seen * segments_.blue[k];
    expected->transparency[at] = seen * segments_.transparency[k];
    expected->last[at] = std::max(before->last[at], segments_.back[k]);
    if (segments_.front[k] < before->last[at] - 0.01 &&
        segments_.back[k] - segments_.front[k] > 0.01)
      ++violations;
  }
  EXPECT_EQ(composite_segments(*frame_, segments_, segments_.count, *buffer_), violations);
  EXPECT_GT(violations, 20U);
  for (std::size_t at = 0; at < buffer_->red.size(); ++at) {
    ASSERT_DOUBLE_EQ(buffer_->red[at], expected->red[at]) << at;
    ASSERT_DOUBLE_EQ(buffer_->green[at], expected->green[at]) << at;
    ASSERT_DOUBLE_EQ(buffer_->blue[at], expected->blue[at]) << at;
    ASSERT_EQ(buffer_->transparency[at], expected->transparency[at]) << at;
    ASSERT_EQ(buffer_->last[at], expected->last[at]) << at;
  }
}

}  // namespace
}  // namespace hiac
