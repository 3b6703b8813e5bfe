#include "hiac/order/published/face_plane.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/meshes.hpp"

namespace hiac::test {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kLeast = std::numeric_limits<double>::min();

// A brick of 2 by 3 by 4 whose bottom's corner 2 is raised.
ZooMesh raised_brick(double by) {
  return make_mesh(
      {{1, 2, 3}, {3, 2, 3}, {3, 5, 3 + by}, {1, 5, 3}, {1, 2, 7}, {3, 2, 7}, {3, 5, 7}, {1, 5, 7}},
      {{CellKind::brick8, {0, 1, 2, 3, 4, 5, 6, 7}}});
}

TEST(FacePlane, ScalesAreThoseOfTheMeshsBox) {
  const MeshScale scale(raised_brick(0));
  EXPECT_EQ(scale.extent, 2 + 3 + 4);
  EXPECT_EQ(scale.rounding, 7 * kEpsilon);
  const MeshScale low(moved(raised_brick(0), [](const Position& p) {
    return Position{p[0] - 20, p[1], p[2]};
  }));
  EXPECT_EQ(low.rounding, 19 * kEpsilon);
  const MeshScale nothing(make_mesh({}, {}));
  EXPECT_EQ(nothing.extent, 0);
  EXPECT_EQ(nothing.rounding, 0);
}

TEST(FacePlane, OfATriangleIsThroughItsCorners) {
  const ZooMesh mesh = make_mesh({{1, 1, 1}, {3, 1, 1}, {1, 4, 1}, {1, 1, 6}},
                                 {{CellKind::tetrahedron4, {0, 1, 2, 3}}});
  const CellCorners corners(mesh, 0);
  EXPECT_EQ(corners.filled_up(), 4U);
  const MeshScale scale(mesh);
  // corners 0, 1 and 3: edges (2, 0, 0) and (0, 0, 5)
  FacePlane plane = plane_of_face(corners, topology_of(CellKind::tetrahedron4).faces[0], scale);
  EXPECT_EQ(plane.normal, (Position{0, -10, 0}));
  EXPECT_EQ(plane.point, (Position{1, 1, 1}));
  EXPECT_EQ(plane.size, 5);
  EXPECT_EQ(plane.deviation, 0);
  EXPECT_EQ(plane.value({7, 3, 8}), -30);
  const double rounding = 6 * kEpsilon, extent = 10;
  EXPECT_DOUBLE_EQ(plane.certain_slope, 4 * kEpsilon * 10);
  EXPECT_DOUBLE_EQ(plane.touching, 4 * rounding * 10);
  EXPECT_DOUBLE_EQ(plane.touching_slope, 4 * kEpsilon * 10 + 4 * rounding * 7);
  EXPECT_DOUBLE_EQ(plane.touch(3), plane.touching + 3 * plane.touching_slope);
  EXPECT_DOUBLE_EQ(plane.certain, plane.certain_slope * extent + kLeast * (extent + 1));
  EXPECT_DOUBLE_EQ(plane.apart, plane.touch(extent) + kLeast * (extent + 1));
  flip(plane);
  EXPECT_EQ(plane.value({7, 3, 8}), 30);
}

// The face of the corners 0, 3, 2 and 1, whose diagonals are (2, 3, h) and (2, -3, 0): their cross
// product is (3 h, 2 h, -12), from which the corners are off by 3 h.
TEST(FacePlane, OfAQuadrilateralIsParallelToItsDiagonals) {
  for (const double by : {0.0, 0.5, -0.5}) {
    const double off = std::abs(by), extent = by < 0 ? 9 + off : 9;
    const ZooMesh mesh = raised_brick(by);
    const MeshScale scale(mesh);
    const FacePlane plane =
        plane_of_face(CellCorners(mesh, 0), topology_of(CellKind::brick8).faces[4], scale);
    EXPECT_EQ(plane.normal, (Position{3 * by, 2 * by, -12}));
    EXPECT_EQ(plane.point, (Position{2, 3.5, 3 + by / 4}));
    EXPECT_EQ(plane.size, 5 + off);
    EXPECT_DOUBLE_EQ(plane.deviation, 3 * off);
    EXPECT_DOUBLE_EQ(plane.certain_slope, 4 * kEpsilon * (5 + off) * 5);
    EXPECT_DOUBLE_EQ(plane.touching, 4 * scale.rounding * (5 + off) * 5 + 3 * off);
    EXPECT_DOUBLE_EQ(plane.touching_slope,
                     plane.certain_slope + 4 * scale.rounding * (5 + off + 5));
    EXPECT_DOUBLE_EQ(plane.certain, plane.certain_slope * extent + kLeast * (extent + 1));
    EXPECT_DOUBLE_EQ(plane.apart, plane.touch(extent) + kLeast * (extent + 1));
  }
}

// Cells with an odd number of corners repeat the last one.
TEST(FacePlane, CornersAreThoseOfTheCell) {
  const ZooMesh mesh =
      make_mesh({{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.25, 2}},
                {{CellKind::pyramid5, {1, 2, 3, 4, 5}}});
  const CellCorners corners(mesh, 0);
  ASSERT_EQ(corners.filled_up(), 6U);
  EXPECT_EQ(corners.nodes.size(), 5U);
  EXPECT_EQ(corners.at(1)[0], 1);
  EXPECT_EQ(corners.at(4)[2], 2);
  for (const std::size_t k : {4U, 5U}) {
    EXPECT_EQ(corners.coordinates[0][k], 0.5);
    EXPECT_EQ(corners.coordinates[1][k], 0.25);
    EXPECT_EQ(corners.coordinates[2][k], 2);
  }
}

}  // namespace
}  // namespace hiac::test
