// How far a displaced ray meets a curved face from where the ray itself does, by hand.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/frame/frame.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/render/cells/curved/curved_faces.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac {
namespace {

using test::cube_scene;
using test::Position;

// A brick seen from above, in pixels of a world unit; its top is what `shape` makes of the nodes at
// height 1.
class DoubtByHandTest : public testing::Test {
 protected:
  template <typename Shape>
  void view(CellKind kind, const Shape& shape) {
    std::vector<Position> positions;
    test::Cell cell{kind, {}};
    for (const Position& p : reference_nodes(kind)) {
      cell.nodes.push_back(static_cast<NodeId>(positions.size()));
      positions.push_back(p[2] == 1 ? shape(p) : p);
      positions.back()[0] += left_;
      positions.back()[1] += low_;
    }
    mesh_ = test::make_mesh(positions, {cell});
    test::add_node_field(mesh_, "f", [](const Position&) { return 0.5; });
    Scene scene = cube_scene(Projection::orthographic, 8, 8);
    scene.camera.eye = {0, 0, 9};
    scene.camera.look_at = {0, 0, 0};
    scene.camera.up = {0, 1, 0};
    scene.camera.height = 8;
    projector_.emplace(scene.camera, scene.image);
    frame_.emplace(mesh_, scene, *projector_);
    surface_ = cell_surface(kind, mesh_.cell_nodes(0));
    faces_.emplace(*frame_, 0, surface_);
    std::array<bool, CellSurface::kMostCorners> above{};
    for (std::size_t k = 0; k < surface_.corner_count; ++k)
      above[k] = frame_->nodes[surface_.nodes[k]].y <= kRow;
    faces_->begin_row(kRow, {0, 0, 8, 8}, above.data());
  }

  // Of the top, on the ray of pixel 5 of the row, which meets it at these reference coordinates.
  [[nodiscard]] double doubt(double xi, double eta, double displaced) const {
    std::size_t top = 0;
    for (std::size_t f = 0; f < 6; ++f)
      if (faces_->holds(f) && faces_->reference(f, 0.25, 0.25)[2] == 1) top = f;
    for (const auto& [u, v] : {std::pair{xi, eta},
                               {1 - xi, eta},
                               {xi, 1 - eta},
                               {1 - xi, 1 - eta},
                               {eta, xi},
                               {1 - eta, xi},
                               {eta, 1 - xi},
                               {1 - eta, 1 - xi}}) {
      const auto at = faces_->reference(top, u, v);
      if (std::abs(at[0] - xi) + std::abs(at[1] - eta) < 1e-12)
        return faces_->doubt(top, u, v, 5, displaced);
    }
    ADD_FAILURE() << "no such place";
    return 0;
  }

  static constexpr double kRow = 2.5;  // y = 1.5 in the world, x = 1.5 at pixel 5
  double left_ = 1, low_ = 1;
  ZooMesh mesh_;
  std::optional<Projector> projector_;
  std::optional<Frame> frame_;
  CellSurface surface_;
  std::optional<CurvedFaces> faces_;
};

// Height 1 + 3 u v over a unit square: slopes of 3/2 both ways in the middle, and 3 for the mixed
// derivative, on a box of twice the displacement, which may be as large as (1 + 2/32)^2 of it.
TEST_F(DoubtByHandTest, OfABilinearFace) {
  view(CellKind::brick8, [](Position p) {
    if (p[0] == 1 && p[1] == 1) p[2] = 4;
    return p;
  });
  for (const double d : {1e-9, 1e-4, 0.01, 0.0156}) {
    const double bent = 3 * (1.0625 * 1.0625) * (2 * d) * (2 * d);
    EXPECT_NEAR(doubt(0.5, 0.5, d), 1.01 * 3 * d + bent + d, 1e-9 * d) << d;
  }
  // a box of more than 1/32 to either side is none
  EXPECT_EQ(doubt(0.5, 0.5, 0.0157), std::numeric_limits<double>::infinity());
  // beside the ray by 0.001 in x: so much more
  const double d = 1e-3, off = 1e-3;
  const double bent = 3 * (1.0625 * 1.0625) * (2 * d) * (2 * (d + off));
  EXPECT_NEAR(doubt(0.501, 0.5, d), 1.01 * (1.5 * (d + off) + 1.503 * d) + bent + d, 1e-9);
}

// Displaced by as much along its normal, a steep face's place moves by nearly so much.
TEST_F(DoubtByHandTest, IsNearWhatADisplacementDoes) {
  for (const double steep : {1.0, 10.0, 100.0}) {
    view(CellKind::brick8, [&](Position p) {
      p[2] = 1 + steep * (p[0] + p[1]);
      if (p[0] == 1 && p[1] == 1) p[2] += 1e-5 * steep;  // or it would be planar
      return p;
    });
    const double d = 1e-6, moves = d * std::sqrt(1 + 2 * steep * steep);
    EXPECT_GE(doubt(0.5, 0.5, d), moves);
    EXPECT_LE(doubt(0.5, 0.5, d), 2 * moves);
  }
}

// Nodes moved by e = 0.24 along x, x(u) = u + 4 e u (1 - u), nearly touch the ray where they turn:
// at u = 0.98 with x' = 0.0784, and x'' = -8 e at most (1 + 2/32)^4 times. The box is taken into
// itself where that bends it by no more than 0.9 of its half: for displacements of up to 0.00113.
TEST_F(DoubtByHandTest, IsNoneWhereTheFaceNearlyTouchesTheRay) {
  constexpr double e = 0.24, u = 0.98, slope = 1 + 4 * e * (1 - 2 * u);
  left_ = 1.5 - (u + 4 * e * u * (1 - u));
  view(CellKind::brick20, [](Position p) {
    if (p[0] == 0.5) p[0] += e;
    p[2] += 0.5 * p[0];
    return p;
  });
  const double curvature = 8 * e * std::pow(1.0625, 4);
  const double most = 0.9 * slope * slope / (2 * curvature) / slope * slope;
  const double largest = 0.9 / (2 * curvature / (slope * slope));
  EXPECT_NEAR(most, largest, 1e-9);
  EXPECT_LT(2 * largest / slope, 1.0 / 32);
  EXPECT_TRUE(std::isfinite(doubt(u, 0.5, 0.99 * largest)));
  EXPECT_EQ(doubt(u, 0.5, 1.01 * largest), std::numeric_limits<double>::infinity());
}

// Close to where the face turns its height changes by more than its slope says: with x(u) = u + 4 e
// u (1 - u) and a height of 100 u, a ray moved aside by d meets it where x(u + s) = x(u) + d.
TEST_F(DoubtByHandTest, CountsTheBendOfFacesThatNearlyTouchTheRay) {
  constexpr double e = 0.24, at = 0.98, slope = 1 + 4 * e * (1 - 2 * at), steep = 100;
  const double place = at + 4 * e * at * (1 - at);
  for (const std::size_t axis : {0, 1}) {
    left_ = axis == 0 ? 1.5 - place : 1;
    low_ = axis == 1 ? 1.5 - place : 1;
    view(CellKind::brick20, [&](Position p) {
      p[2] += steep * p[axis];
      if (p[axis] == 0.5) p[axis] += e;
      return p;
    });
    const double d = 1e-3;
    const double moves = steep * (slope - std::sqrt(slope * slope - 16 * e * d)) / (8 * e);
    ASSERT_GT(moves, 1.2 * steep * d / slope);
    const double doubted = axis == 0 ? doubt(at, 0.5, d) : doubt(0.5, at, d);
    EXPECT_GE(doubted, moves) << axis;
    EXPECT_LE(doubted, 3 * moves) << axis;
  }
}

// Bends along both of the picture's axes add up where the face is sheared: places u along the
// sheared axis solve u - 10 u^2 = a - 10 b for a ray moved aside by (a, b).
TEST_F(DoubtByHandTest, AddsTheBendsOfShearedFaces) {
  constexpr double shear = 10, bend = 5, steep = 100, d = 1.4e-3;
  for (const bool turned : {false, true}) {
    left_ = low_ = 1;
    view(CellKind::brick20, [&](const Position& p) {
      const double u = p[turned ? 1 : 0] - 0.5, v = p[turned ? 0 : 1] - 0.5;
      const double along = 0.5 + u + shear * v - bend * u * u;
      const double across = 0.5 + v + bend / shear * u * u;
      return turned ? Position{across, along, 1 + steep * u}
                    : Position{along, across, 1 + steep * u};
    });
    const double farthest = d * std::sqrt(1 + shear * shear);
    const double moves = steep * (1 - std::sqrt(1 - 8 * bend * farthest)) / (4 * bend);
    EXPECT_GE(doubt(0.5, 0.5, d), moves) << turned;
    EXPECT_LE(doubt(0.5, 0.5, d), 3 * moves) << turned;
  }
}

}  // namespace
}  // namespace hiac
