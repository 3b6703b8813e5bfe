#include "hiac/order/gaps/gap_window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using test::Position;

constexpr double kRelative = 32 * std::numeric_limits<double>::epsilon();
constexpr double kOpening = 1 + 1e-9;

SeenFace face_of(const std::vector<Position>& corners) {
  SeenFace face{{}, corners.size(), 1};
  for (std::size_t k = 0; k < corners.size(); ++k) face.corners[k] = corners[k].data();
  return face;
}

// Along z a window's x is the world's y, and its y the other way round the world's x.
TEST(GapWindow, PlacesAFaceInAParallelView) {
  const Window window({false, {}, {0, 0, 3}}, {0, 0, 2}, false);
  EXPECT_FALSE(window.pyramid());
  const std::vector<Position> corners{{1, 5, 2}, {3, -4, 8}, {-2, 1, 4}, {7, 6, -9}};
  for (const std::size_t count : {3U, 4U}) {
    const std::vector<Position> used(corners.begin(), corners.begin() + static_cast<int>(count));
    Outline outline{};
    ASSERT_TRUE(window.place(face_of(used), outline));
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(outline.at_x[k], corners[std::min(k, count - 1)][1]);
      EXPECT_EQ(outline.at_y[k], -corners[std::min(k, count - 1)][0]);
    }
    const double farthest = count == 3 ? 8 : 9;
    EXPECT_DOUBLE_EQ(outline.error, kRelative * farthest);
    EXPECT_DOUBLE_EQ(outline.x.low, -4 - outline.error);
    EXPECT_DOUBLE_EQ(outline.x.high, (count == 3 ? 5 : 6) + outline.error);
    EXPECT_DOUBLE_EQ(outline.y.low, (count == 3 ? -3 : -7) - outline.error);
    EXPECT_DOUBLE_EQ(outline.y.high, 2 + outline.error);
    EXPECT_DOUBLE_EQ(outline.depth.low, (count == 3 ? 2 : -9) - kRelative * farthest);
    EXPECT_DOUBLE_EQ(outline.depth.high, 8 + kRelative * farthest);
    // the same as a hull
    std::vector<Vector> points(used.begin(), used.end());
    points.push_back(points.front());
    Outline hull{};
    ASSERT_TRUE(window.place_hull(points, hull));
    EXPECT_EQ(hull.x.low, outline.x.low);
    EXPECT_EQ(hull.y.high, outline.y.high);
    EXPECT_EQ(hull.depth.high, outline.depth.high);
    EXPECT_EQ(hull.error, outline.error);
  }
}

TEST(GapWindow, PlacesAFaceInPerspective) {
  const Window window({true, {1, 2, 3}, {}}, {0, 0, 5}, false);
  const std::vector<Position> corners{
      {1 + 2, 2 + 1, 3 + 2}, {1, 2 - 4, 3 + 2}, {1 - 4, 2 + 8, 3 + 4}};
  Outline outline{};
  ASSERT_TRUE(window.place(face_of(corners), outline));
  const std::array<double, 4> x{0.5, -2, 2, 2}, y{-1, 0, 1, 1};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_DOUBLE_EQ(outline.at_x[k], x[k]);
    EXPECT_DOUBLE_EQ(outline.at_y[k], y[k]);
  }
  // of the largest coordinate, 8, by the least depth, 2, times 1 and the largest place, 2
  EXPECT_DOUBLE_EQ(outline.error, kRelative * 8 / 2 * 3);
  EXPECT_DOUBLE_EQ(outline.depth.low, 2 - kRelative * 8);
  EXPECT_DOUBLE_EQ(outline.depth.high, 4 + kRelative * 8);
  std::vector<Vector> points(corners.begin(), corners.end());
  points.push_back(points.front());
  Outline hull{};
  ASSERT_TRUE(window.place_hull(points, hull));
  EXPECT_EQ(hull.error, outline.error);
  EXPECT_EQ(hull.x.high, outline.x.high);
}

// Coordinates of a window are right-handed, orthogonal and of one scale, whatever its axis is.
TEST(GapWindow, AxesAreOrthogonal) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    Position axis{number(random), number(random), number(random)};
    if (trial < 24)  // along or nearly along coordinates
      for (std::size_t c = 0; c < 3; ++c)
        axis[c] = c == static_cast<std::size_t>(trial) % 3 ? (trial % 2 == 0 ? 1 : -1)
                                                           : (trial < 12 ? 0 : 1e-12 * axis[c]);
    const Window window({false, {}, axis}, axis, false);
    const std::vector<Position> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    std::array<Vector, 4> seen;
    for (std::size_t k = 0; k < 4; ++k) {
      Outline outline{};
      ASSERT_TRUE(window.place(face_of({corners[k], corners[k], corners[k]}), outline));
      seen[k] = {outline.at_x[0], outline.at_y[0], 0.5 * (outline.depth.low + outline.depth.high)};
    }
    EXPECT_EQ(seen[0], (Vector{0, 0, 0}));
    const Vector &x = seen[1], &y = seen[2], &z = seen[3];
    EXPECT_NEAR(dot(x, cross(y, z)), 1, 1e-14);
    for (const auto& [a, b] : {std::pair{x, y}, {y, z}, {z, x}}) {
      EXPECT_NEAR(dot(a, b), 0, 1e-14);
      EXPECT_NEAR(dot(a, a), 1, 1e-14);
    }
    EXPECT_NEAR(x[2], axis[0] / length(axis), 1e-14);
    EXPECT_NEAR(z[2], axis[2] / length(axis), 1e-14);
  }
}

// The part of a triangle inside |x|, |y| <= depth, by points all over the triangle.
TEST(GapWindow, OfPyramidsTheVisiblePartCounts) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> number;
  const View view{true, {0.5, -1, 2}, {}};
  const Window window(view, {0, 0, 1}, true);
  EXPECT_TRUE(window.pyramid());
  std::size_t seen = 0, hidden = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<Position> corners;
    for (int k = 0; k < 3; ++k)
      corners.push_back({0.5 + 2 * number(random), -1 + 2 * number(random), 3 + number(random)});
    Outline outline{};
    const bool placed = window.place(face_of(corners), outline);
    Interval x, y, depth;
    constexpr int kSteps = 60;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; i + j <= kSteps; ++j) {
        Position p;
        for (std::size_t c = 0; c < 3; ++c)
          p[c] =
              (i * corners[0][c] + j * corners[1][c] + (kSteps - i - j) * corners[2][c]) / kSteps -
              view.eye[c];
        if (!(std::max(std::abs(p[0]), std::abs(p[1])) <= p[2])) continue;
        x.include(p[1] / p[2]);
        y.include(-p[0] / p[2]);
        depth.include(p[2]);
      }
    if (!x.empty()) {
      ASSERT_TRUE(placed) << trial;
    }
    ++(placed ? seen : hidden);
    if (!placed || x.empty()) continue;
    for (const auto& [bounds, sampled] :
         {std::pair{outline.x, x}, {outline.y, y}, {outline.depth, depth}}) {
      EXPECT_LE(bounds.low, sampled.low) << trial;
      EXPECT_GE(bounds.high, sampled.high) << trial;
    }
    EXPECT_GE(outline.x.low, -1 - 1e-8);
    EXPECT_LE(outline.x.high, 1 + 1e-8);
    EXPECT_GE(outline.y.low, -1 - 1e-8);
    EXPECT_LE(outline.y.high, 1 + 1e-8);
    EXPECT_GE(outline.depth.low, depth.low - 0.3);
    EXPECT_LE(outline.depth.high, depth.high + 0.3);
  }
  EXPECT_GT(seen, 100U);
  EXPECT_GT(hidden, 20U);
}

TEST(GapWindow, OfPyramidsAHullFillsAllUnlessItIsBesideThem) {
  const View view{true, {1, 1, 1}, {}};
  const Window window(view, {0, 0, 1}, true);
  const auto placed = [&](const Position& by, Outline& outline) {
    std::vector<Vector> points{{-1, 0, 3}, {1, 0, 4}, {0, 1, 5}, {0.5, -1, 3}};
    for (Vector& p : points)
      for (std::size_t c = 0; c < 3; ++c) p[c] += 1 + by[c];
    return window.place_hull(points, outline);
  };
  Outline outline{};
  ASSERT_TRUE(placed({0, 0, 0}, outline));
  EXPECT_EQ(outline.x.low, -kOpening);
  EXPECT_EQ(outline.x.high, kOpening);
  EXPECT_EQ(outline.y.low, -kOpening);
  EXPECT_EQ(outline.y.high, kOpening);
  EXPECT_DOUBLE_EQ(outline.depth.low, 3 - kRelative * 5);
  EXPECT_DOUBLE_EQ(outline.depth.high, 5 + kRelative * 5);
  // reaching behind the eye
  ASSERT_TRUE(placed({0, 0, -4}, outline));
  EXPECT_DOUBLE_EQ(outline.depth.low, -kRelative * outline.depth.high / (1 + kRelative));
  EXPECT_FALSE(placed({0, 0, -5.1}, outline));  // all of it
  // the last point to be inside, towards each side: (-1, 0, 3), (1, 0, 4), ...
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(placed({side * 3.9, 0, 0}, outline));
    EXPECT_TRUE(placed({0, side * 3.9, 0}, outline));
    EXPECT_FALSE(placed({side * 6.1, 0, 0}, outline));
    EXPECT_FALSE(placed({0, side * 6.1, 0}, outline));
  }
}

TEST(GapWindow, OneSeesAMeshBesideTheEyeAndSixOneAroundIt) {
  const ZooMesh mesh = test::structured(1, test::Cut::bricks);
  const auto count = [&](const View& view, const std::vector<Vector>& points = {}) {
    return windows_of(mesh, points, view).size();
  };
  EXPECT_EQ(count({false, {}, {1, 0, 0}}), 1U);
  EXPECT_EQ(count({true, {0.5, 0.5, 0.5}, {}}), 6U);
  EXPECT_EQ(count({true, {0, 0.5, 0.5}, {}}), 6U);  // on the border
  for (std::size_t c = 0; c < 3; ++c)
    for (const double beside : {-0.1, 1.1}) {
      Position eye{0.5, 0.5, 0.5};
      eye[c] = beside;
      const std::vector<Window> windows = windows_of(mesh, {}, {true, eye, {}});
      ASSERT_EQ(windows.size(), 1U);
      EXPECT_FALSE(windows[0].pyramid());
      // all of the mesh is before the eye
      Outline outline{};
      std::vector<Vector> corners;
      for (NodeId node = 0; node < 8; ++node) {
        const auto p = mesh.position(node);
        corners.push_back({p[0], p[1], p[2]});
      }
      ASSERT_TRUE(windows[0].place_hull(corners, outline));
      EXPECT_GT(outline.depth.low, 0.09);
      // a point of a hull on the other side
      Vector point{0.5, 0.5, 0.5};
      point[c] = beside < 0 ? -0.2 : 1.2;
      EXPECT_EQ(count({true, eye, {}}, {point}), 6U);
      point[c] = 0.5;
      EXPECT_EQ(count({true, eye, {}}, {point}), 1U);
    }
}

// Each direction is in the pyramid along its largest coordinate.
TEST(GapWindow, PyramidsSeeAllDirections) {
  const ZooMesh mesh = test::structured(1, test::Cut::bricks);
  const std::vector<Window> windows = windows_of(mesh, {}, {true, {0.5, 0.5, 0.5}, {}});
  ASSERT_EQ(windows.size(), 6U);
  for (std::size_t w = 0; w < 6; ++w) {
    EXPECT_TRUE(windows[w].pyramid());
    const double sign = w % 2 == 0 ? -1 : 1;
    for (std::size_t other = 0; other < 6; ++other) {
      const double other_sign = other % 2 == 0 ? -1 : 1;
      std::vector<Position> corners(3, Position{0.5, 0.5, 0.5});
      corners[0][other / 2] += other_sign;
      corners[1][other / 2] += other_sign, corners[1][(other / 2 + 1) % 3] += 0.1;
      corners[2][other / 2] += other_sign, corners[2][(other / 2 + 2) % 3] += 0.1;
      Outline outline{};
      EXPECT_EQ(windows[w].place(face_of(corners), outline), w == other) << sign;
    }
  }
}

}  // namespace
}  // namespace hiac
