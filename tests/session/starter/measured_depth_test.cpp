#include "hiac/session/starter/measured_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/meshes.hpp"

namespace hiac::starter {
namespace {

using test::Position;

// A box that is sheared in x: u, v and w from 0 to 1 lie at these places.
Position place_of(const Position& p) {
  return {2 * p[0] + 0.5 * p[1] - 1, 3 * p[1] - 2, 1.5 * p[2] + 4};
}
Position box_coordinates(const Position& p) {
  const double v = (p[1] + 2) / 3;
  return {(p[0] + 1 - 0.5 * v) / 2, v, (p[2] - 4) / 1.5};
}

double extinction_at(const Position& uvw) { return 0.3 + uvw[0] + 2 * uvw[1] + 0.5 * uvw[2]; }

Camera camera_from(const Position& eye, const Position& look_at) {
  Camera camera;
  camera.eye = eye;
  camera.look_at = look_at;
  camera.up = {0, 0, 1};
  camera.fov = 40;
  return camera;
}

Camera aside() { return camera_from({4.5, -7.2, 8.7}, {0.3, -0.4, 4.6}); }

/// The same by the box's six planes: 96 x 72 rays through the part of it below w = `top`, along
/// which the extinction is linear.
MeasuredDepth by_planes(const Camera& camera, const ImageSize& size, double top) {
  const auto minus = [](const Position& a, const Position& b) {
    return Position{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  const auto cross = [](const Position& a, const Position& b) {
    return Position{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                    a[0] * b[1] - a[1] * b[0]};
  };
  const auto unit = [](const Position& a) {
    const double length = std::hypot(a[0], a[1], a[2]);
    return Position{a[0] / length, a[1] / length, a[2] / length};
  };
  const Position ahead = unit(minus(camera.look_at, camera.eye));
  const Position right = unit(cross(ahead, camera.up)), up = cross(right, ahead);
  const double half_height = std::tan(camera.fov / 2 * std::numbers::pi / 180);
  const double half_width = half_height * size.width / size.height;
  const Position limits{1, 1, top}, from = box_coordinates(camera.eye);
  double covered = 0, sum = 0;
  for (int row = 0; row < 72; ++row)
    for (int column = 0; column < 96; ++column) {
      const double x = ((column + 0.5) / 48 - 1) * half_width;
      const double y = (1 - (row + 0.5) / 36) * half_height;
      Position direction{}, beyond{};
      for (std::size_t a = 0; a < 3; ++a) {
        direction[a] = ahead[a] + x * right[a] + y * up[a];
        beyond[a] = camera.eye[a] + direction[a];
      }
      const Position along = minus(box_coordinates(beyond), from);
      double enter = 0, leave = std::numeric_limits<double>::infinity();
      for (std::size_t a = 0; a < 3; ++a) {
        const double low = (0 - from[a]) / along[a], high = (limits[a] - from[a]) / along[a];
        enter = std::max(enter, std::min(low, high));
        leave = std::min(leave, std::max(low, high));
      }
      if (enter >= leave) continue;
      const double middle = (enter + leave) / 2;
      const double extinction = extinction_at(
          {from[0] + middle * along[0], from[1] + middle * along[1], from[2] + middle * along[2]});
      covered += 1;
      sum += extinction * (leave - enter) * std::hypot(direction[0], direction[1], direction[2]);
    }
  return {covered / (96 * 72), covered > 0 ? sum / covered : 0};
}

double at_corner(const ZooMesh& mesh, CellId cell, std::size_t corner) {
  const auto p = mesh.position(mesh.cell_nodes(cell)[corner]);
  return extinction_at(box_coordinates({p[0], p[1], p[2]}));
}

TEST(MeasuredDepth, OfABoxIsThatBetweenItsPlanesWhateverItsCells) {
  for (const test::Cut cut :
       {test::Cut::bricks, test::Cut::tetrahedra, test::Cut::prisms, test::Cut::pyramids}) {
    const ZooMesh mesh = test::moved(test::structured(4, cut), place_of);
    for (const ImageSize& size : {ImageSize{160, 100}, ImageSize{100, 130}}) {
      const MeasuredDepth truth = by_planes(aside(), size, 1);
      const MeasuredDepth found = measure_depth(
          mesh, aside(), size,
          [&](CellId cell, std::size_t corner) { return at_corner(mesh, cell, corner); });
      EXPECT_GT(truth.coverage, 0.05);
      EXPECT_LT(truth.coverage, 0.5);
      EXPECT_DOUBLE_EQ(found.coverage, truth.coverage);
      EXPECT_NEAR(found.mean / truth.mean, 1, 1e-12);
    }
  }
}

// The extinction of a cell in which the field has no value at a corner is unknown.
TEST(MeasuredDepth, CellsWithoutAnExtinctionCountAsNone) {
  const ZooMesh mesh = test::moved(test::structured(2, test::Cut::bricks), place_of);
  const ImageSize size{160, 100};
  const MeasuredDepth found =
      measure_depth(mesh, aside(), size, [&](CellId cell, std::size_t corner) {
        return cell >= 4 && corner == cell - 1 ? std::nan("") : at_corner(mesh, cell, corner);
      });
  const MeasuredDepth truth = by_planes(aside(), size, 0.5);  // the lower four
  EXPECT_DOUBLE_EQ(found.coverage, truth.coverage);
  EXPECT_NEAR(found.mean / truth.mean, 1, 1e-12);
}

TEST(MeasuredDepth, IsThatOfThePartsInThePicture) {
  const ZooMesh mesh = test::moved(test::structured(3, test::Cut::tetrahedra), place_of);
  const ImageSize size{90, 90};
  // from near: the box reaches beyond the picture on every side
  const Camera near = camera_from({2.4, -3.1, 6.9}, {0.3, -0.4, 4.6});
  const MeasuredDepth found = measure_depth(mesh, near, size, [&](CellId cell, std::size_t corner) {
    return at_corner(mesh, cell, corner);
  });
  const MeasuredDepth truth = by_planes(near, size, 1);
  EXPECT_GT(truth.coverage, 0.6);
  EXPECT_DOUBLE_EQ(found.coverage, truth.coverage);
  EXPECT_NEAR(found.mean / truth.mean, 1, 1e-12);
}

TEST(MeasuredDepth, IsZeroWhereNoRayMeetsACell) {
  const auto one = [](CellId, std::size_t) { return 1.0; };
  const ZooMesh mesh = test::moved(test::structured(2, test::Cut::bricks), place_of);
  const Camera away = camera_from({4.5, -7.2, 8.7}, {8.7, -14, 12.8});
  const MeasuredDepth behind = measure_depth(mesh, away, {160, 100}, one);
  EXPECT_EQ(behind.coverage, 0);
  EXPECT_EQ(behind.mean, 0);
  const ZooMesh flat = test::moved(mesh, [](const Position& p) {
    return Position{p[0], p[1], 5};
  });  // without any volume
  const MeasuredDepth none = measure_depth(flat, aside(), {160, 100}, one);
  EXPECT_EQ(none.coverage, 0);
  EXPECT_EQ(none.mean, 0);
}

}  // namespace
}  // namespace hiac::starter
