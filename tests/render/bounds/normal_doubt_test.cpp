// How far the skin's normals may be off: by hand, and against the normals of the true faces.
#include "hiac/render/bounds/normal_doubt.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/rounding.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/render/cells/curved/patch_curvature.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/cell_points.hpp"

namespace hiac {
namespace {

using test::Position;

constexpr double kUnknownAngle = 2;

// One cell, whose nodes are those of the reference cell moved by a map.
class OneCell {
 public:
  OneCell(CellKind kind, const std::function<Position(const Position&)>& map,
          double planarity = Scene{}.render.planarity)
      : scene_(test::cube_scene(Projection::orthographic, 8, 8)), kind_(kind) {
    scene_.render.planarity = planarity;
    scene_.camera.eye = {0.5, 0.5, 3};
    scene_.camera.look_at = {0.5, 0.5, 0};
    scene_.camera.up = {0, 1, 0};
    std::vector<Position> positions;
    test::Cell cell{kind, {}};
    for (const Position& p : reference_nodes(kind)) {
      cell.nodes.push_back(static_cast<NodeId>(positions.size()));
      positions.push_back(map(p));
    }
    mesh_ = test::make_mesh(positions, {cell});
    test::add_node_field(mesh_, "f", [](const Position& p) { return p[0]; });
    projector_ = std::make_unique<const Projector>(scene_.camera, scene_.image);
    frame_ = std::make_unique<const Frame>(mesh_, scene_, *projector_);
  }

  [[nodiscard]] const Frame& frame() const { return *frame_; }
  // The face with all of these corners.
  [[nodiscard]] std::size_t face_with(const std::vector<std::uint8_t>& corners) const {
    const auto faces = topology_of(kind_).faces;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto own = std::span(faces[f].corners).first(faces[f].corner_count);
      if (std::ranges::all_of(
              corners, [&](std::uint8_t k) { return std::ranges::find(own, k) != own.end(); }))
        return f;
    }
    ADD_FAILURE() << "no such face";
    return 0;
  }
  [[nodiscard]] Vector point(std::size_t face, double u, double v) const {
    return test::point_of_cell(mesh_, 0, test::reference_on_face(kind_, face, u, v));
  }
  // Of the true face, by differences.
  [[nodiscard]] Vector normal(std::size_t face, double u, double v) const {
    constexpr double h = 1e-5;
    const auto at = [&](double a, double b) { return point(face, a, b); };
    return unit(cross(minus(at(u + h, v), at(u - h, v)), minus(at(u, v + h), at(u, v - h))));
  }

 private:
  ZooMesh mesh_;
  Scene scene_;
  CellKind kind_;
  std::unique_ptr<const Projector> projector_;
  std::unique_ptr<const Frame> frame_;
};

double angle_between(const Vector& a, const Vector& b) {
  return std::atan2(length(cross(a, b)), std::abs(dot(a, b)));
}

// 8 u of the rotation; and edges off by 32 extended units turn it by 2.4 times that over the least
// of the areas that two edges span, times the longest edge.
TEST(PlanarNormalDoubt, OfTrianglesIsThatOfTheirRounding) {
  constexpr double u = kUnit, e = 32 * kExtendedUnit;
  const OneCell cell(CellKind::tetrahedron4, [](const Position& p) {
    return Position{4 * p[0], 1e-4 * p[1], p[2]};
  });
  // the base has edges of 4 and 1e-4
  const double off = e * std::hypot(4, 1e-4);
  EXPECT_NEAR(planar_normal_doubt(cell.frame(), 0, cell.face_with({0, 1, 2})),
              8 * u + 1.2 * 2 * off * std::hypot(4, 1e-4) / 4e-4, 1e-6 * u);
  // another one edges of 4 and 1
  EXPECT_NEAR(planar_normal_doubt(cell.frame(), 0, cell.face_with({0, 1, 3})),
              8 * u + 1.2 * 2 * e * 17 / 4, 1e-6 * u);
}

// No area: nothing is known.
TEST(PlanarNormalDoubt, OfFlatFacesIsAll) {
  const OneCell cell(
      CellKind::tetrahedron4,
      [](const Position& p) {
        return Position{p[0] + p[1], 0, p[2]};
      },
      1e-3);
  EXPECT_GE(planar_normal_doubt(cell.frame(), 0, cell.face_with({0, 1, 2})), kUnknownAngle);
}

// A corner of the unit square lifted by h: the diagonals' normal is (-h/2, -h/2, 1), and those at
// the corners beside the lifted one are off by h/2 in one direction alone.
TEST(PlanarNormalDoubt, OfTwistedFacesIsTheTurnToTheirCorners) {
  for (const double h : {1e-7, 1e-5, 1e-3, 0.1}) {
    const OneCell cell(
        CellKind::brick8,
        [h](const Position& p) {
          return Position{p[0], p[1], p[2] + h * p[0] * p[1] * p[2]};
        },
        0.5);
    const std::size_t top = cell.face_with({4, 5, 6, 7});
    const Vector drawn = unit(Vector{-h / 2, -h / 2, 1});
    double most = 0;
    for (const double x : {0.0, 1.0})
      for (const double y : {0.0, 1.0})
        most = std::max(most, length(cross(unit(Vector{-h * y, -h * x, 1}), drawn)));
    const double doubt = planar_normal_doubt(cell.frame(), 0, top);
    EXPECT_NEAR(doubt, 1.2 * most, 1e-3 * most + 1e-13) << h;
    for (const double x : {0.01, 0.3, 0.99})
      for (const double y : {0.01, 0.6, 0.99})
        EXPECT_LE(angle_between(cell.normal(top, x, y), drawn), doubt + 1e-9);
  }
  // a turn whose sine is one half or more
  const OneCell steep(
      CellKind::brick8,
      [](const Position& p) {
        return Position{p[0], p[1], p[2] + 3 * p[0] * p[1] * p[2]};
      },
      10);
  EXPECT_GE(planar_normal_doubt(steep.frame(), 0, steep.face_with({4, 5, 6, 7})), kUnknownAngle);
}

// Nodes off their places by d, within the planarity: 2 n w d of derivatives, with the weights of
// the face's degree, over the area; twice that, as both edges may be off.
TEST(PlanarNormalDoubt, CountsNodesOffTheirPlaces) {
  struct Case {
    CellKind kind;
    double degree, weights;
  };
  for (const Case& c : {Case{CellKind::brick20, 2, 4.8}, Case{CellKind::brick32, 3, 14.4},
                        Case{CellKind::tetrahedron10, 2, 4.8}})
    for (const double d : {1e-8, 1e-6}) {
      const auto is_moved = [](const Position& p) {
        return p[0] > 0.2 && p[0] < 0.8 && p[1] == 0 && p[2] == 0;
      };
      const OneCell cell(
          c.kind,
          [&](const Position& p) {
            return is_moved(p) ? Position{p[0], p[1], p[2] + d} : p;
          },
          1e-3);
      const bool is_brick = c.kind != CellKind::tetrahedron10;
      const double longest = is_brick ? 1 : std::sqrt(2.0);
      for (const std::size_t face :
           {cell.face_with({0, 1, 2}), cell.face_with({0, 1, std::uint8_t(is_brick ? 4 : 3)})}) {
        const double expected = 1.2 * 2 * (2 * c.degree * c.weights * d) * longest;
        const double doubt = planar_normal_doubt(cell.frame(), 0, face);
        EXPECT_NEAR(doubt, expected, 1e-3 * expected) << kind_name(c.kind);
        const Vector drawn = face == cell.face_with({0, 1, 2}) ? Vector{0, 0, 1} : Vector{0, 1, 0};
        for (double u = 0.01; u < 1; u += 0.07)
          for (double v = 0.01; u + v < 1; v += 0.07)
            EXPECT_LE(angle_between(cell.normal(face, u, v), drawn), doubt + 1e-9);
      }
      // none of the opposite face's nodes is off
      EXPECT_LT(
          planar_normal_doubt(cell.frame(), 0,
                              is_brick ? cell.face_with({4, 5, 6, 7}) : cell.face_with({1, 2, 3})),
          1e-13);
    }
}

// The top of a brick over the unit square is z = 1 + 4 h x (1 - x): -8 h is its second derivative,
// which the border around the patch makes larger.
TEST(CurvedNormalDoubt, IsTheTurnOfAParabola) {
  const double beyond = std::pow(1 + 2 * PatchCurvature::kBorder, 4);
  for (const double h : {0.05, 0.25}) {
    const OneCell cell(CellKind::brick20, [h](const Position& p) {
      return Position{p[0], p[1], p[2] * (1 + 4 * h * p[0] * (1 - p[0]))};
    });
    const std::size_t top = cell.face_with({4, 5, 6, 7});
    for (const double x : {0.5, 0.25, 0.9})
      for (const double off : {1e-10, 1e-7, 1e-5}) {
        const double slope = 4 * h * (1 - 2 * x);
        const double along_x = std::sqrt(1 + slope * slope), along_y = 1, area = along_x;
        const double bent = 8 * h * beyond, stretch = area / std::hypot(along_x, along_y);
        const double moved = 1.5 * bent * 2 * off / stretch;
        const double expected =
            8 * kUnit + 1.2 * (moved * (along_x + along_y) + moved * moved) / area;
        const double found = curved_normal_doubt(cell.frame(), 0, top, {x, 0.3, 1}, off);
        // roundings of derivatives and shape functions besides
        EXPECT_NEAR(found, expected, 1e-6 * expected + 1e-11) << h << ' ' << x << ' ' << off;
        EXPECT_GT(found, expected);
      }
  }
}

// Where nothing is off, rounding is: 64 u for every product with a node's distance, times the
// square of the order, and 4 u of the cell's distance for all derivatives.
TEST(CurvedNormalDoubt, CountsTheRoundingOfDerivatives) {
  for (const auto& [kind, order] : {std::pair{CellKind::brick20, 2.0}, {CellKind::brick32, 3.0}}) {
    const OneCell cell(kind, [](const Position& p) {
      return Position{p[0], p[1], p[2] * (1 + p[0] * (1 - p[0]))};
    });
    const std::size_t top = cell.face_with({4, 5, 6, 7});
    const Vector at{0.5, 0.5, 1};
    std::array<Vector, kMaxNodesPerCell> gradients;
    shape_gradients<double>(kind, at, gradients);
    double sum = 0, weights = 0, reach = 0;
    const auto place = [&](std::size_t k) {
      const auto p = cell.frame().mesh.position(cell.frame().mesh.cell_nodes(0)[k]);
      return Vector{p[0], p[1], p[2]};
    };
    for (std::size_t k = 0; k < node_count(kind); ++k) {
      sum += length(minus(place(k), place(0)));
      reach = std::max(reach, length(minus(place(k), Vector{0.5, 0.5, 0})));
      weights += std::max(std::abs(gradients[k][0]), std::abs(gradients[k][1]));
    }
    const double rounding = kUnit * (64 * order * order * sum + 4 * weights * reach);
    EXPECT_NEAR(curved_normal_doubt(cell.frame(), 0, top, at, 0), 8 * kUnit + 1.2 * 2 * rounding,
                1e-3 * rounding)
        << kind_name(kind);
  }
}

// The way to the true point stays within the border, and the face does not turn by more than that
// its area is known.
TEST(CurvedNormalDoubt, IsAllWhereTheTruePointMayBeFar) {
  const double beyond = std::pow(1 + 2 * PatchCurvature::kBorder, 4), root = std::sqrt(2.0);
  const auto doubt = [](double h, double off) {
    const OneCell cell(CellKind::brick20, [h](const Position& p) {
      return Position{p[0], p[1], p[2] * (1 + 4 * h * p[0] * (1 - p[0]))};
    });
    return curved_normal_doubt(cell.frame(), 0, cell.face_with({4, 5, 6, 7}), {0.5, 0.5, 1}, off);
  };
  // a radius of 2 sqrt(2) off
  const double widest = PatchCurvature::kBorder / 2 / (2 * root);
  EXPECT_LT(doubt(0.01, 0.999 * widest), 0.1);
  EXPECT_EQ(doubt(0.01, 1.001 * widest), kUnknownAngle);
  // the radius times the bend is no more than the stretch; doubts are of order 1 there already
  const double h = 20, most = 1 / root / (8 * h * beyond) / (2 * root);
  ASSERT_LT(most, widest);
  EXPECT_GE(doubt(h, 1.001 * most), kUnknownAngle);
  EXPECT_LT(doubt(h, 0.1 * most), kUnknownAngle);
}

// Normals at points of the face that are as near as may be.
TEST(CurvedNormalDoubt, HoldsBetweenPointsOfAFace) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> any(0.05, 0.95), sign(-1, 1);
  for (const CellKind kind :
       {CellKind::brick8, CellKind::brick20, CellKind::brick32, CellKind::tetrahedron10,
        CellKind::tetrahedron20, CellKind::prism15, CellKind::prism24}) {
    const OneCell cell(kind, [](const Position& p) { return test::rippled(p, 0.06); });
    double closest = 0;
    const std::size_t faces = topology_of(kind).faces.size();
    for (int trial = 0; trial < 400; ++trial) {
      const auto face = static_cast<std::size_t>(trial) % faces;
      double u = any(random), v = any(random);
      if (u + v > 0.95) {
        u = 0.95 - 0.9 * u;
        v = 0.95 - 0.9 * v;
      }
      const double by = std::pow(10, -2.5 - any(random)), a = by * sign(random),
                   b = by * sign(random);
      const double off = length(minus(cell.point(face, u, v), cell.point(face, u + a, v + b)));
      const double doubt = curved_normal_doubt(cell.frame(), 0, face,
                                               test::reference_on_face(kind, face, u, v), off);
      const double turned = angle_between(cell.normal(face, u, v), cell.normal(face, u + a, v + b));
      ASSERT_LE(turned, doubt + 1e-9) << kind_name(kind);
      closest = std::max(closest, turned / doubt);
    }
    EXPECT_GT(closest, 0.01) << kind_name(kind);
  }
}

}  // namespace
}  // namespace hiac
