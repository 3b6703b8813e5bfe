// Rays and normals in the camera's frame, against differences of points of the faces.
#include "hiac/render/cells/face_normals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/cell_points.hpp"

namespace hiac {
namespace {

Projector projector_of(Projection projection) {
  const Scene scene = test::cube_scene(projection, 20, 14);
  return {scene.camera, scene.image};
}

void expect_near(const Vector& a, const Vector& b, double tolerance) {
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance);
}

TEST(RayThrough, PointsAwayFromTheEye) {
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    const Projector projector = projector_of(projection);
    for (const auto& [x, y] : {std::pair{0.5, 0.5}, {13.5, 2.5}, {10.0, 7.0}}) {
      const Vector ray = ray_through(projector, x, y);
      const Vector way = projector.direction(x, y);
      expect_near(ray, unit(projector.camera_vector(way)), 1e-15);
      expect_near(ray_through(projector, x, y, projector.ray_scale(x, y)), ray, 0);
    }
  }
}

TEST(NormalBetween, IsAcrossBothDirections) {
  const Projector projector = projector_of(Projection::perspective);
  const Vector a{0.3, -0.7, 0.2}, b{0.9, 0.1, -0.4};
  const Vector expected = unit(projector.camera_vector(cross(a, b)));
  expect_near(normal_between(projector, {0.3, -0.7, 0.2}, {0.9, 0.1, -0.4}), expected, 1e-15);
  expect_near(normal_between(projector, {0.3, -0.7, 0.2}, {0.6, -1.4, 0.4}), {0, 0, 1}, 0);
}

// One cell of any kind, bent.
struct BentCell {
  ZooMesh mesh;
  MappedCell mapped;

  BentCell(CellKind kind, const Projector& projector, const test::Position& by) : mapped{kind, {}} {
    std::vector<test::Position> positions;
    test::Cell cell{kind, {}};
    for (const test::Position& p : reference_nodes(kind)) {
      cell.nodes.push_back(static_cast<NodeId>(positions.size()));
      positions.push_back({p[0] + by[0] * p[1] * p[2], p[1] + by[1] * p[0] * (1 - p[0]) * p[2],
                           p[2] + by[2] * p[0] * (1 - p[0])});
    }
    mesh = test::make_mesh(positions, {cell});
    mapped.nodes = relative_positions(mesh, 0, projector);
  }
  [[nodiscard]] Vector point(const Vector& reference) const {
    std::array<double, kMaxNodesPerCell> weights;
    shape_functions<double>(mapped.kind, reference, weights);
    Vector p{};
    for (std::size_t k = 0; k < node_count(mapped.kind); ++k)
      for (std::size_t c = 0; c < 3; ++c) p[c] += weights[k] * mapped.nodes[k][c];
    return p;
  }
};

// All kinds but those whose faces collapse where differences are taken.
TEST(NormalAt, IsThatOfTheFaceThere) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> in(0.1, 0.45);
  const Projector projector = projector_of(Projection::perspective);
  for (const CellKind kind :
       {CellKind::tetrahedron4, CellKind::tetrahedron10, CellKind::tetrahedron20, CellKind::prism6,
        CellKind::prism15, CellKind::prism24, CellKind::brick8, CellKind::brick20,
        CellKind::brick32}) {
    const BentCell cell(kind, projector, {0.3, 0.2, 0.4});
    for (std::size_t face = 0; face < topology_of(kind).faces.size(); ++face)
      for (int trial = 0; trial < 5; ++trial) {
        constexpr double h = 1e-5;
        const double u = in(random), v = in(random);
        const auto at = [&](double a, double b) {
          return cell.point(test::reference_on_face(kind, face, a, b));
        };
        const Vector normal =
            cross(minus(at(u + h, v), at(u - h, v)), minus(at(u, v + h), at(u, v - h)));
        expect_near(
            normal_at(projector, cell.mapped, face, test::reference_on_face(kind, face, u, v)),
            unit(projector.camera_vector(normal)), 1e-8);
      }
  }
}

// A top that is a parabola over x from above: from the side it is seen from one side up to its
// highest point at x = 1/2, and from the other side behind it.
TEST(OneSide, EndsWhereAFaceTurnsOver) {
  Scene scene = test::cube_scene(Projection::orthographic, 8, 8);
  scene.camera.eye = {9, 0.5, 0.5};
  scene.camera.look_at = {0.5, 0.5, 0.5};
  scene.camera.up = {0, 0, 1};
  const Projector projector(scene.camera, scene.image);
  const BentCell cell(CellKind::brick20, projector, {0, 0, 1});
  std::size_t top = 0;
  for (std::size_t f = 0; f < 6; ++f)
    if (test::reference_on_face(cell.mapped.kind, f, 0.3, 0.4)[2] == 1) top = f;
  const auto one_side = [&](double from, double to) {
    return is_one_side(projector, cell.mapped, top, {from, 0.3, 1}, {to, 0.6, 1}, 4, 4);
  };
  EXPECT_TRUE(one_side(0.1, 0.45));
  EXPECT_TRUE(one_side(0.45, 0.1));
  EXPECT_TRUE(one_side(0.55, 0.9));
  EXPECT_TRUE(one_side(0.7, 0.7));
  EXPECT_FALSE(one_side(0.1, 0.9));
  EXPECT_FALSE(one_side(0.9, 0.1));
  EXPECT_FALSE(one_side(0.1, 0.6));
  EXPECT_FALSE(one_side(0.45, 0.95));
  // where it turns over at the very end of the way does not count: an eighth of it, halved
  EXPECT_TRUE(one_side(0, 0.5));
  EXPECT_TRUE(one_side(0, 0.53));
  EXPECT_FALSE(one_side(0, 0.54));
  EXPECT_TRUE(one_side(0.47, 1));
  EXPECT_FALSE(one_side(0.46, 1));
}

}  // namespace
}  // namespace hiac
