#include "hiac/render/bounds/ray_displacement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "hiac/base/rounding.hpp"
#include "hiac/geometry/extended_vector.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac {
namespace {

struct Part {
  double from, to;
};

// Of a ray with a direction of length 1 in the tetrahedron 0 <= x, y, z, x + y + z <= 1.
Part part_in_corner(const Vector& origin, const Vector& direction) {
  Part part{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const auto clip = [&](double inside, double slope) {
    if (slope > 0) part.from = std::max(part.from, -inside / slope);
    if (slope < 0) part.to = std::min(part.to, -inside / slope);
  };
  for (std::size_t c = 0; c < 3; ++c) clip(origin[c], direction[c]);
  clip(1 - origin[0] - origin[1] - origin[2], -direction[0] - direction[1] - direction[2]);
  return part;
}

// Rays moved aside by as much as they may be end no farther away than the doubts say, close to
// edges and along faces, too.
TEST(EndDoubts, HoldWhatDisplacementsDo) {
  constexpr double kAside = 1e-3;
  const std::array<Vector, 4> corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const EndDoubts doubts(CellKind::tetrahedron4, corners);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit_range(-1, 1);
  const auto any = [&] {
    return Vector{unit_range(random), unit_range(random), unit_range(random)};
  };
  double closest = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Vector inside{0.3 * std::abs(unit_range(random)), 0.3 * std::abs(unit_range(random)),
                        trial % 3 == 0 ? 1e-4 : 0.3 * std::abs(unit_range(random))};
    Vector direction = any();
    if (trial % 2 == 0) direction[2] *= 1e-3;
    direction = unit(direction);
    Vector origin = inside, moved = inside;
    const Vector aside = unit(any());
    for (std::size_t c = 0; c < 3; ++c) {
      origin[c] -= 3 * direction[c];
      moved[c] = origin[c] + kAside * aside[c];
    }
    const Part here = part_in_corner(origin, direction), there = part_in_corner(moved, direction);
    const EndDoubts::Doubts d = doubts.at(origin, direction, {.at_ends = kAside});
    ASSERT_LE(std::abs(here.from - there.from), d.front);
    ASSERT_LE(std::abs(here.to - there.to), d.back);
    closest = std::max(closest, std::abs(here.to - there.to) / d.back);
  }
  EXPECT_GT(closest, 0.4);  // they are taken twice as large
}

// Twice the displacement at the ends, and 16 u of the corners' distances, over the cosine.
TEST(EndDoubts, AreThoseOfTheFacesThatTheRayMeets) {
  constexpr double u = 0x1p-53;
  const std::array<Vector, 4> corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const EndDoubts doubts(CellKind::tetrahedron4, corners);
  const Vector origin{0.25, 0.25, 0}, direction{0, 0, 2};
  const double slanted = std::sqrt(3);
  const EndDoubts::Doubts d = doubts.at(origin, direction, {.at_ends = 1e-3, .along = 1e-5});
  EXPECT_NEAR(d.front, 2e-3 + 1e-5, 1e-12);
  EXPECT_NEAR(d.back, 2e-3 * slanted + 1e-5, 1e-12);
  // what rounding alone leaves: 16 u, far from the origin along the ray
  const EndDoubts::Doubts least = doubts.at(origin, direction, {});
  EXPECT_NEAR(least.front, 16 * u, u * 1e-3);
  // face 0 is opposite to corner 0 or not: the slanted one is met at a cosine of 1 / sqrt(3)
  for (std::size_t face = 0; face < 4; ++face) {
    const auto& used = topology_of(CellKind::tetrahedron4).faces[face].corners;
    const bool has_first = used[0] == 0 || used[1] == 0 || used[2] == 0;
    const bool has_last = used[0] == 3 || used[1] == 3 || used[2] == 3;
    const double by = has_first ? 1 : slanted;
    const double rounding = doubts.through(face, direction, {});
    if (has_first && has_last)
      EXPECT_EQ(rounding, std::numeric_limits<double>::infinity());  // edge-on
    else
      EXPECT_NEAR(rounding, 16 * u * by, u * 1e-3);
    if (!has_first) {
      EXPECT_NEAR(doubts.through(face, direction, {.at_ends = 1e-3, .along = 1e-5}),
                  2e-3 * by + 1e-5, 1e-12);
    }
  }
  // in extended precision rounding is that of its own
  const BasicEndDoubts<long double> extended(
      CellKind::tetrahedron4,
      std::array<ExtendedVector, 4>{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  for (std::size_t face = 0; face < 4; ++face)
    if (const double by = extended.through(face, {0, 0, 1}, {}); std::isfinite(by)) {
      EXPECT_NEAR(by / (16 * kExtendedUnit), doubts.through(face, direction, {}) / (16 * u), 1e-6);
    }
}

// A face without area says nothing about where the ray ends.
TEST(EndDoubts, OfFlatCellsAreInfinite) {
  const std::array<Vector, 4> corners{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}}};
  const EndDoubts doubts(CellKind::tetrahedron4, corners);
  const EndDoubts::Doubts d = doubts.at({0.25, 0, -1}, {0, 0.5, 1}, {.at_ends = 1e-3});
  EXPECT_EQ(d.front, std::numeric_limits<double>::infinity());
  EXPECT_EQ(d.back, std::numeric_limits<double>::infinity());
  for (std::size_t face = 0; face < 4; ++face) {
    const auto& used = topology_of(CellKind::tetrahedron4).faces[face].corners;
    const bool has_last = used[0] == 3 || used[1] == 3 || used[2] == 3;
    const double by = doubts.through(face, {0, 0.5, 1}, {.at_ends = 1e-3});
    EXPECT_EQ(std::isfinite(by), has_last) << face;
  }
}

// Pictures of 8 x 8 pixels, one of them a world unit, or at a depth of 4.
class RayDisplacementTest : public testing::Test {
 protected:
  static constexpr double u = 0x1p-53;

  RayDisplacement displacement(const ZooMesh& mesh, Projection projection) {
    Scene scene = test::cube_scene(projection, 8, 8);
    scene.camera.eye = {0, 0, 4};
    scene.camera.look_at = {0, 0, 0};
    scene.camera.up = {0, 1, 0};
    scene.camera.height = 8;
    scene.camera.fov = 90;
    ZooMesh with_field = mesh;
    test::add_node_field(with_field, "f", [](const test::Position& p) { return p[0]; });
    const Projector projector(scene.camera, scene.image);
    const Frame frame(with_field, scene, projector);
    return ray_displacement(frame, 0);
  }

  static void expect_same(double value, double expected) {
    EXPECT_NEAR(value, expected, 1e-10 * expected);
  }
};

constexpr std::array<test::Position, 4> kCorners{
    {{0.25, 0.25, 0}, {2.25, 0.25, 0}, {0.25, 1.25, 0}, {0.4375, 0.4375, 3}}};

// Corners at 4.25 to 6.25 and 2.75 to 3.75 pixels: 2 u of 6.25, 20 u of 2, 32 extended u of the
// farthest corner's distance; along the ray 16 u of that.
TEST_F(RayDisplacementTest, OfTetrahedraIsThatOfTheScreen) {
  const ZooMesh mesh = test::one_cell(CellKind::tetrahedron4, {kCorners.begin(), kCorners.end()});
  const double pixels = u * (2 * 6.25 + 20 * 2);
  const double reach = std::sqrt(2 * 0.4375 * 0.4375 + 9);
  const RayDisplacement parallel = displacement(mesh, Projection::orthographic);
  expect_same(parallel.aside, 32 * kExtendedUnit * reach + pixels);
  expect_same(parallel.at_ends, parallel.aside);
  expect_same(parallel.along, 16 * u * reach);
  EXPECT_EQ(parallel.spread, 1);
  // depths from 1 to 4; a pixel is a quarter of a unit at depth 1
  const double far = std::sqrt(2.25 * 2.25 + 0.25 * 0.25 + 16);
  const RayDisplacement central = displacement(mesh, Projection::perspective);
  EXPECT_DOUBLE_EQ(central.spread, 4);
  expect_same(central.aside, 32 * kExtendedUnit * far + pixels * far / 4);
  expect_same(central.along, 16 * u * 4 * far);
}

// A corner on a column of centres may have been moved there.
TEST_F(RayDisplacementTest, CountsTheMoveToCentres) {
  auto corners = kCorners;
  for (auto& p : corners) p[0] += 0.25;
  const ZooMesh mesh = test::one_cell(CellKind::tetrahedron4, {corners.begin(), corners.end()});
  const double reach = std::sqrt(0.6875 * 0.6875 + 0.4375 * 0.4375 + 9);
  expect_same(displacement(mesh, Projection::orthographic).aside,
              0x1p-38 + 32 * kExtendedUnit * reach + u * (2 * 6.5 + 20 * 2));
}

// Other cells: 24 u of the distance and 64 u of their size in the world, and where they end what
// the screen does to them.
TEST_F(RayDisplacementTest, OfOtherCellsIsThatOfTheWorld) {
  std::vector<test::Position> corners;
  for (const auto& p : reference_nodes(CellKind::brick8))
    corners.push_back({0.25 + 2 * p[0], 0.25 + p[1], 3 * p[2]});
  const ZooMesh mesh = test::one_cell(CellKind::brick8, corners);
  const double reach = std::sqrt(2.25 * 2.25 + 1.25 * 1.25 + 9), size = std::sqrt(14);
  const RayDisplacement d = displacement(mesh, Projection::orthographic);
  const double screen = 32 * kExtendedUnit * reach + u * (2 * 6.25 + 20 * 2);
  EXPECT_NEAR(d.aside, u * (24 * reach + 64 * size), 1e-3 * u);
  EXPECT_NEAR(d.at_ends, u * (24 * reach + 64 * size) + screen, 1e-3 * u);
  expect_same(d.along, 16 * u * reach);
}

// A face of four corners that counts as planar, one of them off by 4e-12: each is off the plane by
// a quarter of it, which counts twice.
TEST_F(RayDisplacementTest, CountsWhatPlanarFacesAreOff) {
  std::vector<test::Position> corners;
  for (const auto& p : reference_nodes(CellKind::brick8)) corners.push_back({p[0], p[1], p[2]});
  const double flat =
      displacement(test::one_cell(CellKind::brick8, corners), Projection::orthographic).at_ends;
  corners[6][2] += 4e-12;
  const double bent =
      displacement(test::one_cell(CellKind::brick8, corners), Projection::orthographic).at_ends;
  EXPECT_NEAR(bent - flat, 2e-12, 2e-14);
}

// A brick that counts as an affine image of the unit cube, one corner off by e = 2^-47 along x: its
// map is off by twice that, and of the four corners of its side every one by a quarter of e.
TEST_F(RayDisplacementTest, CountsWhatAffineMapsAreOff) {
  constexpr double e = 0x1p-47;
  std::vector<test::Position> corners;
  for (const auto& p : reference_nodes(CellKind::brick8)) corners.push_back({p[0], p[1], p[2]});
  const double exact =
      displacement(test::one_cell(CellKind::brick8, corners), Projection::orthographic).aside;
  corners[6][0] += e;
  const double off =
      displacement(test::one_cell(CellKind::brick8, corners), Projection::orthographic).aside;
  EXPECT_NEAR(off - exact, 2 * e + 2 * e / 4, 1e-3 * e);
}

/// The unit tetrahedron of order 2, some of its mid-edge nodes moved along z.
ZooMesh quadratic_tetrahedron(const std::map<std::size_t, double>& lifted) {
  std::vector<test::Position> nodes;
  for (const auto& p : reference_nodes(CellKind::tetrahedron10))
    nodes.push_back({p[0], p[1], p[2]});
  for (const auto& [node, by] : lifted) nodes[node][2] += by;
  return test::one_cell(CellKind::tetrahedron10, nodes);
}

// Edges that count as straight are off by up to seven times what their nodes are.
TEST_F(RayDisplacementTest, CountsWhatStraightEdgesAreOff) {
  constexpr double e = 0x1p-38;
  const auto d = [&](const std::map<std::size_t, double>& lifted) {
    return displacement(quadratic_tetrahedron(lifted), Projection::orthographic);
  };
  const RayDisplacement straight = d({}), off = d({{4, e}});
  EXPECT_NEAR(off.aside - straight.aside, 7 * e, 1e-3 * e);
  EXPECT_NEAR(off.at_ends - straight.at_ends, 7 * e, 1e-3 * e);
}

// Of a cell with curved faces the others end where they count as straight: off by up to four times
// what a node is. The planarity is 1e-10, and nodes count that are off by twice that.
TEST_F(RayDisplacementTest, CountsWhatStraightFacesOfCurvedCellsAreOff) {
  const auto d = [&](const std::map<std::size_t, double>& lifted) {
    return displacement(quadratic_tetrahedron(lifted), Projection::orthographic);
  };
  // node 4 is on the edge 0-1, node 9 on 2-3
  const RayDisplacement exact = d({{4, 0.125}});
  for (const double e : {0x1p-38, 0x1p-33, 1.9e-10}) {
    const RayDisplacement off = d({{4, 0.125}, {9, e}});
    EXPECT_NEAR(off.at_ends - exact.at_ends, 4 * e, 1e-3 * e) << e;
    EXPECT_NEAR(off.aside, exact.aside, 1e-3 * e) << e;
  }
  EXPECT_NEAR(d({{4, 0.125}, {9, 4e-10}}).at_ends, exact.at_ends, 1e-12);
}

// Twisted faces of linear cells: 64 u of the distance.
TEST_F(RayDisplacementTest, OfTwistedCellsIsThatOfTheirFaces) {
  std::vector<test::Position> corners;
  for (const auto& p : reference_nodes(CellKind::brick8)) corners.push_back({p[0], p[1], p[2]});
  corners[6] = {1.5, 1.5, 1.5};
  const RayDisplacement d =
      displacement(test::one_cell(CellKind::brick8, corners), Projection::orthographic);
  const double rounding = 64 * u * (std::sqrt(6.75) + 4);
  expect_same(d.along, rounding);
  EXPECT_NEAR(d.aside, u * (24 + 64) * std::sqrt(6.75) + rounding, 1e-3 * u);
}

// Curved faces: 192 u and 512 u of the distance, from the picture's corner, by order.
TEST_F(RayDisplacementTest, OfCurvedCellsGrowsWithTheOrder) {
  for (const auto& [order, count] :
       {std::pair{CellOrder::quadratic, 192.0}, {CellOrder::cubic, 512.0}}) {
    ZooMesh mesh = test::of_order(
        test::one_cell(CellKind::tetrahedron4, {kCorners.begin(), kCorners.end()}), order);
    mesh = test::moved(mesh, [](test::Position p) {
      p[0] += 0.03 * std::sin(2 * p[0] + 5 * p[1] + 3 * p[2]);
      return p;
    });
    double reach = 0, corner_reach = 0, size = 0;
    std::array<double, 2> low{9, 9}, high{-9, -9};
    double widest = 0;
    for (NodeId k = 0; k < mesh.node_count(); ++k) {
      const auto p = mesh.position(mesh.cell_nodes(0)[k]);
      const auto first = mesh.position(mesh.cell_nodes(0)[0]);
      reach = std::max(reach, std::hypot(p[0], p[1], p[2]));
      size = std::max(size, std::hypot(p[0] - first[0], p[1] - first[1], p[2] - first[2]));
      if (k >= 4) continue;
      corner_reach = std::max(corner_reach, std::hypot(p[0], p[1], p[2]));
      for (std::size_t c = 0; c < 2; ++c) {
        low[c] = std::min(low[c], p[c]);
        high[c] = std::max(high[c], p[c]);
      }
      widest = std::max({widest, 4 + p[0], 4 - p[1]});
    }
    const RayDisplacement d = displacement(mesh, Projection::orthographic);
    const double rounding = count * u * (reach + 4);
    const double inside = u * (24 * corner_reach + 64 * size) + rounding;
    const double screen = 32 * kExtendedUnit * corner_reach +
                          u * (2 * widest + 20 * std::max(high[0] - low[0], high[1] - low[1]));
    expect_same(d.aside, inside);
    expect_same(d.at_ends, inside + screen);
    expect_same(d.along, rounding);
  }
}

}  // namespace
}  // namespace hiac
