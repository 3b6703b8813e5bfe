#include "hiac/session/starter/starter_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/meshes.hpp"

namespace hiac::starter {
namespace {

ZooMesh stretched_box(const std::array<double, 3>& size) {
  return test::moved(test::structured(3, test::Cut::bricks), [&](const test::Position& p) {
    return test::Position{size[0] * p[0] + 0.2 * size[0] * p[1], size[1] * p[1] + 3,
                          size[2] * p[2] - 7};
  });
}

// Right, up and ahead of who looks along a direction, head up.
std::array<Vec, 3> axes_along(const Vec& direction) {
  const Vec ahead = unit(direction), right = unit(Vec{ahead[1], -ahead[0], 0});
  return {right, cross(right, ahead), ahead};
}

std::vector<Vec> nodes_of(const ZooMesh& mesh) {
  std::vector<Vec> points;
  for (const test::Position& p : test::positions_of(mesh)) points.push_back(p);
  return points;
}

std::vector<Vec> corners_of(const Box& box) {
  std::vector<Vec> points;
  for (unsigned k = 0; k < 8; ++k)
    points.push_back({(k & 1U) != 0 ? box.high[0] : box.low[0],
                      (k & 2U) != 0 ? box.high[1] : box.low[1],
                      (k & 4U) != 0 ? box.high[2] : box.low[2]});
  return points;
}

/// How far points lie from the picture's middle at most, across and upright: 1 is its border.
std::array<double, 2> reach(const Camera& camera, const ImageSize& size,
                            const std::vector<Vec>& points) {
  const auto [right, up, ahead] = axes_along(view_direction(camera));
  const double half_height = std::tan(camera.fov / 2 * std::numbers::pi / 180);
  const double half_width = half_height * size.width / size.height;
  std::array<double, 2> most{};
  for (const Vec& point : points) {
    const Vec p = point - camera.eye;
    EXPECT_GT(dot(p, ahead), 0);
    most[0] = std::max(most[0], std::fabs(dot(p, right)) / (dot(p, ahead) * half_width));
    most[1] = std::max(most[1], std::fabs(dot(p, up)) / (dot(p, ahead) * half_height));
  }
  return most;
}

const std::vector<Vec> kDirections{{0.55, -0.75, 0.45}, {0.9, -0.3, 0.35}, {-0.2, 0.4, 0.8}};
const std::vector<ImageSize> kSizes{{160, 90}, {100, 100}, {70, 200}};

TEST(StarterCamera, SeesAllNodesFromNoFartherThanItMust) {
  for (const std::array<double, 3>& box :
       {std::array<double, 3>{1, 1, 1}, {5, 1, 2}, {0.03, 0.02, 0.09}, {0, 300, 700}}) {
    const ZooMesh mesh = stretched_box(box);
    for (const ImageSize& size : kSizes)
      for (const Vec& direction : kDirections) {
        const Camera camera = camera_around(Sight(mesh), size, direction);
        const auto [across, upright] = reach(camera, size, nodes_of(mesh));
        // the eye's coordinates are rounded to a thousandth of the mesh's size
        EXPECT_NEAR(std::max(across, upright), 0.94, 0.006) << box[0] << " " << size.width;
        EXPECT_EQ(camera.projection, Projection::perspective);
        EXPECT_EQ(camera.fov, 30);
        EXPECT_EQ(camera.up, (Vec{0, 0, 1}));
      }
  }
}

TEST(StarterCamera, LooksFromTheDirectionAtTheMiddleOfWhatItSees) {
  const ZooMesh mesh = stretched_box({5, 1, 2});
  for (const Vec& direction : kDirections) {
    const Camera camera = camera_around(Sight(mesh), {160, 90}, direction);
    const Vec towards_eye = unit(camera.eye - camera.look_at);
    EXPECT_LT(length(cross(towards_eye, unit(direction))), 1e-3);
    EXPECT_GT(dot(towards_eye, direction), 0);
    for (const Vec& axis : axes_along(-1 * direction)) {
      double low = 1e9, high = -1e9;
      for (const Vec& point : nodes_of(mesh)) {
        low = std::min(low, dot(point, axis));
        high = std::max(high, dot(point, axis));
      }
      EXPECT_NEAR(dot(camera.look_at, axis), (low + high) / 2, 1e-3);
    }
  }
}

TEST(StarterCamera, HasCoordinatesOfAThousandthOfTheSize) {
  const auto is_multiple = [](double value, double step) {
    return std::fabs(value / step - std::round(value / step)) < 1e-6;
  };
  for (const auto& [length, step] :
       {std::pair{5.0, 1e-3}, std::pair{0.5, 1e-4}, std::pair{70000.0, 10.0}}) {
    const ZooMesh mesh = stretched_box({length / 1.2, length / 7, length / 3});  // sheared by 0.2
    const Camera camera = camera_around(Sight(mesh), {160, 90}, kDirections[0]);
    bool all_coarse = true;
    for (const double value : {camera.eye[0], camera.eye[1], camera.eye[2], camera.look_at[0],
                               camera.look_at[1], camera.look_at[2]}) {
      EXPECT_TRUE(is_multiple(value, step)) << value << " " << step;
      all_coarse = all_coarse && is_multiple(value, 10 * step);
    }
    EXPECT_FALSE(all_coarse) << step;
  }
}

// The truth is seen by the box's eight corners.
TEST(StarterCamera, SeesTheBoxOfASeriesToo) {
  const ZooMesh mesh = stretched_box({1, 1, 1});
  const Box own = box_of_cells(mesh);
  EXPECT_TRUE(Sight(mesh).corners.empty());
  EXPECT_TRUE(Sight(mesh, own).corners.empty());
  EXPECT_TRUE(Sight(mesh, Box{own.low, own.low}).corners.empty());  // the mesh reaches farther
  for (const Box& further : {Box{own.low, {own.high[0], own.high[1], own.high[2] + 4}},
                             Box{{own.low[0] - 4, own.low[1], own.low[2]}, own.high}}) {
    const Sight sight(mesh, further);
    EXPECT_EQ(sight.box.low, further.low);
    EXPECT_EQ(sight.box.high, further.high);
    EXPECT_EQ(sight.corners.size(), 8U);
    for (const ImageSize& size : kSizes) {
      const Camera camera = camera_around(sight, size, kDirections[0]);
      const auto [across, upright] = reach(camera, size, corners_of(further));
      EXPECT_NEAR(std::max(across, upright), 0.94, 0.006);
    }
  }
}

TEST(StarterCamera, APictureThatFitsIsFilledBothWays) {
  const ImageSize most{1024, 768};
  for (const std::array<double, 3>& box :
       {std::array<double, 3>{8, 1, 1}, {1, 1, 9}, {1, 6, 1}, {3, 3, 0.2}}) {
    const ZooMesh mesh = stretched_box(box);
    for (const Vec& direction : kDirections) {
      const ImageSize size = fitting_size(Sight(mesh), most, direction);
      const auto [across, upright] =
          reach(camera_around(Sight(mesh), most, direction), most, nodes_of(mesh));
      const double wanted = across / upright * 1024 / 768;  // width over height
      EXPECT_EQ(wanted > 1024.0 / 768 ? size.width : size.height,
                wanted > 1024.0 / 768 ? 1024U : 768U);
      // the other side: the next even number
      const double exact = wanted > 1024.0 / 768 ? 1024 / wanted : 768 * wanted;
      const std::uint32_t side = wanted > 1024.0 / 768 ? size.height : size.width;
      EXPECT_EQ(side % 2, 0U);
      EXPECT_GE(side, exact - 1e-9);
      EXPECT_LT(side, exact + 2);
      EXPECT_GT(side, 64U);
    }
  }
}

TEST(StarterCamera, PicturesHave64PixelsASideOrMore) {
  const ZooMesh needle = stretched_box({1, 1, 400});
  EXPECT_EQ(fitting_size(Sight(needle), {1024, 768}, {0.55, -0.75, 0}), (ImageSize{64, 768}));
  const ZooMesh plate = stretched_box({400, 300, 0.01});
  EXPECT_EQ(fitting_size(Sight(plate), {1024, 768}, {0.55, -0.75, 0.01}), (ImageSize{1024, 64}));
}

TEST(StarterCamera, FramesAreRightHandedAndUpright) {
  Camera camera;
  camera.eye = {1, 2, 3};
  camera.look_at = {6, 2, 3};  // along x
  camera.up = {0, 0, 1};
  const Frame along = frame_of(camera);
  EXPECT_EQ(along.ahead, (Vec{1, 0, 0}));
  EXPECT_EQ(along.right, (Vec{0, -1, 0}));
  EXPECT_EQ(along.up, (Vec{0, 0, 1}));
  camera.look_at = {4, 6, -9};  // 3 4 -12
  const Frame down = frame_of(camera);
  const Vec right{0.8, -0.6, 0}, up{3.0 * 12 / 65, 4.0 * 12 / 65, 5.0 / 13};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(down.ahead[c], (std::array{3.0 / 13, 4.0 / 13, -12.0 / 13}[c]), 1e-15);
    EXPECT_NEAR(down.right[c], right[c], 1e-15);
    EXPECT_NEAR(down.up[c], up[c], 1e-15);
  }
}

TEST(StarterCamera, NumbersAreRoundedToAThousandthOfAPowerOfTen) {
  EXPECT_EQ(rounded(0.123456, 1), 0.123);
  EXPECT_EQ(rounded(0.123456, 0.99), 0.1235);
  EXPECT_EQ(rounded(-7.65449, 9.99), -7.654);
  EXPECT_EQ(rounded(-7.65449, 10), -7.65);
  EXPECT_EQ(rounded(123.456, 999), 123.5);
  EXPECT_EQ(rounded(1234.56, 1000), 1235);
  EXPECT_EQ(rounded(123456, 200000), 123500);
  EXPECT_EQ(rounded(-123449, 200000), -123400);
  EXPECT_EQ(rounded(1.23456e-5, 2e-5), 1.235e-5);
}

TEST(StarterCamera, AMeshOfOnePlaceHasNoExtent) {
  const std::vector<test::Cell> cell{{CellKind::tetrahedron4, {0, 1, 2, 3}}};
  const test::Position p{1, 2, 3};
  EXPECT_FALSE(has_extent(test::make_mesh({p, p, p, p}, cell)));
  EXPECT_FALSE(has_extent(test::make_mesh({p, p, p, p, {4, 5, 6}}, cell)));  // of no cell
  for (std::size_t axis = 0; axis < 3; ++axis) {
    test::Position other = p;
    other[axis] += 1e-9;
    EXPECT_TRUE(has_extent(test::make_mesh({p, p, p, other}, cell)));
  }
}

}  // namespace
}  // namespace hiac::starter
