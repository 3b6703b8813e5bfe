#include "hiac/check/quality/cell_quality.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "hiac/base/gauss_legendre.hpp"
#include "hiac/check/quality/mesh_quality.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/check/findings.hpp"

namespace hiac::test {
namespace {

using enum QualityFigure;

/// One cell of a kind: its reference nodes, each moved by `at`.
ZooMesh one_cell(CellKind kind, const std::function<Position(const Position&)>& at) {
  std::vector<Position> places;
  Cell cell{kind, {}};
  for (const auto& p : reference_nodes(kind)) {
    cell.nodes.push_back(static_cast<NodeId>(places.size()));
    places.push_back(at(p));
  }
  return make_mesh(places, {cell});
}

ZooMesh cell_of(CellKind kind, const std::vector<Position>& corners) {
  Cell cell{kind, {}};
  for (NodeId n = 0; n < corners.size(); ++n) cell.nodes.push_back(n);
  return make_mesh(corners, {cell});
}

double figure(const ZooMesh& mesh, QualityFigure of, int hand = 1) {
  return quality_of(mesh, 0, of, hand);
}

/// A rotation, a size and a shift, all not round.
Position anywhere(const Position& p) {
  const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(1.9), t = std::sin(1.9);
  const Position q{c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
  return {3 + 0.37 * q[0], -1 + 0.37 * (d * q[1] - t * q[2]), 7 + 0.37 * (t * q[1] + d * q[2])};
}

TEST(CellQuality, IdealCells) {
  const double t = std::numbers::sqrt3 / 2, h = 1 / std::numbers::sqrt2;
  const double tetrahedral = std::acos(1.0 / 3) * 180 / std::numbers::pi;
  const double octahedral = 180 - tetrahedral;
  const double slope = std::atan(std::numbers::sqrt2) * 180 / std::numbers::pi;
  struct Ideal {
    CellKind kind;
    std::vector<Position> corners;
    double volume, least, largest;
  };
  const std::vector<Ideal> ideals{
      {CellKind::tetrahedron4,
       {{0, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}},
       1.0 / 3,
       tetrahedral,
       tetrahedral},
      {CellKind::pyramid5,
       {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, h}},
       h / 3,
       slope,
       octahedral},
      {CellKind::prism6,
       {{0, 0, 0}, {0.5, t, 0}, {1, 0, 0}, {0, 0, 1}, {0.5, t, 1}, {1, 0, 1}},
       t / 2,
       60,
       90},
      {CellKind::brick8,
       {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
       1,
       90,
       90}};
  for (const Ideal& ideal : ideals) {
    const ZooMesh cell = moved(cell_of(ideal.kind, ideal.corners), anywhere);
    const std::string_view name = kind_name(ideal.kind);
    EXPECT_NEAR(figure(cell, volume), ideal.volume * std::pow(0.37, 3), 1e-15) << name;
    EXPECT_NEAR(figure(cell, least_dihedral), ideal.least, 1e-11) << name;
    EXPECT_NEAR(figure(cell, largest_dihedral), ideal.largest, 1e-11) << name;
    EXPECT_NEAR(figure(cell, edge_ratio), 1, 1e-13) << name;
    EXPECT_NEAR(figure(cell, condition), 1, 1e-13) << name;
    EXPECT_NEAR(figure(cell, scaled_jacobian), 1, 1e-13) << name;
    if (ideal.kind == CellKind::tetrahedron4) {
      EXPECT_NEAR(figure(cell, aspect_ratio), 1, 1e-13);
      EXPECT_NEAR(figure(cell, radius_ratio), 1, 1e-13);
    } else {
      EXPECT_NEAR(figure(cell, jacobian_ratio), 1, 1e-12) << name;
    }
    // a mirror image counts the same in a left-handed mesh, and as inverted in a right-handed one
    const ZooMesh mirrored = moved(cell, [](const Position& p) {
      return Position{-p[0], p[1], p[2]};
    });
    for (std::size_t f = 0; f < kFigureCount; ++f) {
      const auto of = static_cast<QualityFigure>(f);
      if (!has_figure(ideal.kind, of)) continue;
      EXPECT_NEAR(figure(mirrored, of, -1), figure(cell, of), 1e-11) << name;
    }
    EXPECT_LT(figure(mirrored, volume), 0);
    EXPECT_LT(figure(mirrored, scaled_jacobian), 0);
    EXPECT_TRUE(std::isnan(figure(mirrored, condition)));
  }
}

/// The corner of a cube: legs of 1 along the axes.
TEST(CellQuality, TheCornerOfACube) {
  const ZooMesh cell = moved(
      cell_of(CellKind::tetrahedron4, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), anywhere);
  const double inscribed = 1 / (3 + std::numbers::sqrt3);
  EXPECT_NEAR(figure(cell, least_dihedral),
              std::acos(1 / std::numbers::sqrt3) * 180 / std::numbers::pi, 1e-11);
  EXPECT_NEAR(figure(cell, largest_dihedral), 90, 1e-11);
  EXPECT_NEAR(figure(cell, edge_ratio), std::numbers::sqrt2, 1e-13);
  EXPECT_NEAR(figure(cell, aspect_ratio), std::numbers::sqrt2 / (2 * std::sqrt(6.0) * inscribed),
              1e-13);
  EXPECT_NEAR(figure(cell, radius_ratio), std::numbers::sqrt3 / 2 / (3 * inscribed), 1e-13);
  // the edges at the far corners: det 1, lengths 1, sqrt 2, sqrt 2
  EXPECT_NEAR(figure(cell, scaled_jacobian), std::numbers::sqrt2 / 2, 1e-13);
}

/// A box a x b x c, and one with its top moved aside by the height: det abc, lengths known.
TEST(CellQuality, BoxesAndTheirShear) {
  const double a = 1, b = 2, c = 5;
  const ZooMesh box = moved(one_cell(CellKind::brick8,
                                     [&](const Position& p) {
                                       return Position{a * p[0], b * p[1], c * p[2]};
                                     }),
                            anywhere);
  const double norm = std::sqrt(a * a + b * b + c * c);
  const double inverse = std::sqrt(1 / (a * a) + 1 / (b * b) + 1 / (c * c));
  EXPECT_NEAR(figure(box, condition), norm * inverse / 3, 1e-12);
  EXPECT_NEAR(figure(box, edge_ratio), 5, 1e-12);
  EXPECT_NEAR(figure(box, scaled_jacobian), 1, 1e-13);
  const ZooMesh sheared = moved(one_cell(CellKind::brick8,
                                         [&](const Position& p) {
                                           return Position{p[0] + p[2], p[1], p[2]};
                                         }),
                                anywhere);
  EXPECT_NEAR(figure(sheared, scaled_jacobian), 1 / std::numbers::sqrt2, 1e-13);
  EXPECT_NEAR(figure(sheared, least_dihedral), 45, 1e-11);
  EXPECT_NEAR(figure(sheared, largest_dihedral), 135, 1e-11);
}

/// The angles between the normals of tetrahedra's faces, each turned away from the fourth node.
TEST(CellQuality, DihedralAnglesByNormals) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 300; ++round) {
    std::vector<Position> corners(4);
    for (Position& p : corners)
      p = {unit(random), unit(random), (round % 3 == 0 ? 0.01 : 1) * unit(random)};
    std::array<Position, 4> normals;
    for (std::size_t k = 0; k < 4; ++k) {
      const Position &a = corners[(k + 1) % 4], &b = corners[(k + 2) % 4],
                     &c = corners[(k + 3) % 4];
      Position u, v, w;
      for (std::size_t i = 0; i < 3; ++i) {
        u[i] = b[i] - a[i], v[i] = c[i] - a[i], w[i] = corners[k][i] - a[i];
      }
      Position n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
      double size = std::hypot(n[0], n[1], n[2]);
      if (n[0] * w[0] + n[1] * w[1] + n[2] * w[2] > 0) size = -size;
      for (std::size_t i = 0; i < 3; ++i) normals[k][i] = n[i] / size;
    }
    double least = 180, largest = 0;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const auto &m = normals[i], &n = normals[j];
        const double cosine = m[0] * n[0] + m[1] * n[1] + m[2] * n[2];
        const double angle =
            180 - std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
        least = std::min(least, angle);
        largest = std::max(largest, angle);
      }
    const ZooMesh cell = cell_of(CellKind::tetrahedron4, corners);
    EXPECT_NEAR(figure(cell, least_dihedral), least, 1e-5);
    EXPECT_NEAR(figure(cell, largest_dihedral), largest, 1e-5);
  }
}

/// A dart: a prism of four corners with one pushed inwards. There the edges of the bottom, and of
/// the top, turn the other way, as if these faces were outside of the sides.
TEST(CellQuality, AnglesAbove180) {
  const ZooMesh dart = moved(cell_of(CellKind::brick8, {{0, 0, 0},
                                                        {2, 0, 0},
                                                        {0.5, 0.5, 0},
                                                        {0, 2, 0},
                                                        {0, 0, 1},
                                                        {2, 0, 1},
                                                        {0.5, 0.5, 1},
                                                        {0, 2, 1}}),
                             anywhere);
  const double sharp = std::atan(0.5 / 1.5) * 180 / std::numbers::pi;
  EXPECT_NEAR(figure(dart, least_dihedral), sharp, 1e-11);
  EXPECT_NEAR(figure(dart, largest_dihedral), 270, 1e-10);
  EXPECT_LT(figure(dart, scaled_jacobian), 0);
}

TEST(CellQuality, WhatIsUndefined) {
  const ZooMesh flat =
      cell_of(CellKind::tetrahedron4, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
  EXPECT_EQ(figure(flat, volume), 0);
  EXPECT_EQ(figure(flat, scaled_jacobian), 0);
  EXPECT_EQ(figure(flat, least_dihedral), 0);
  EXPECT_EQ(figure(flat, largest_dihedral), 180);
  for (const QualityFigure of : {aspect_ratio, radius_ratio, condition})
    EXPECT_TRUE(std::isnan(figure(flat, of)));
  const ZooMesh point =
      cell_of(CellKind::tetrahedron4, {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
  EXPECT_EQ(figure(point, volume), 0);
  for (const QualityFigure of : {least_dihedral, largest_dihedral, edge_ratio, aspect_ratio,
                                 radius_ratio, condition, scaled_jacobian})
    EXPECT_TRUE(std::isnan(figure(point, of))) << description_of(of).key;
}

/// The volume as the integral of the map's Jacobian over the reference cell, cut into slices of
/// boxes whose corners are mapped onto it.
double volume_by_jacobian(const ZooMesh& mesh) {
  const CellKind kind = mesh.kinds[0];
  const GaussRule rule = gauss_legendre(20);
  const CellShape shape = shape_of(kind);
  double sum = 0;
  std::array<std::array<double, 3>, kMaxNodesPerCell> gradients{};
  for (std::size_t i = 0; i < 20; ++i)
    for (std::size_t j = 0; j < 20; ++j)
      for (std::size_t k = 0; k < 20; ++k) {
        double weight = rule.weights[i] * rule.weights[j] * rule.weights[k] / 8;
        Position xi{0.5 + rule.nodes[i] / 2, 0.5 + rule.nodes[j] / 2, 0.5 + rule.nodes[k] / 2};
        const auto shrink = [&](std::size_t axis, double factor) {
          xi[axis] *= factor;
          weight *= factor;
        };
        if (shape == CellShape::tetrahedron) {
          shrink(1, 1 - xi[2]);
          shrink(0, 1 - xi[1] - xi[2]);
        } else if (shape == CellShape::pyramid) {
          shrink(0, 1 - xi[2]);
          shrink(1, 1 - xi[2]);
        } else if (shape == CellShape::prism) {
          shrink(0, 1 - xi[1]);
        } else if (shape == CellShape::wedge) {
          shrink(0, 2 - xi[1] - xi[2]);
        }
        shape_gradients<double>(kind, xi, gradients);
        std::array<Position, 3> j3{};
        for (NodeId n = 0; n < mesh.node_count(); ++n)
          for (std::size_t d = 0; d < 3; ++d)
            for (std::size_t c = 0; c < 3; ++c) j3[d][c] += gradients[n][d] * mesh.position(n)[c];
        sum += weight * (j3[0][0] * (j3[1][1] * j3[2][2] - j3[1][2] * j3[2][1]) +
                         j3[0][1] * (j3[1][2] * j3[2][0] - j3[1][0] * j3[2][2]) +
                         j3[0][2] * (j3[1][0] * j3[2][1] - j3[1][1] * j3[2][0]));
      }
  return sum;
}

TEST(CellQuality, VolumesOfCurvedCellsOfAllKinds) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> push(-0.06, 0.06);
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    const ZooMesh cell = one_cell(kind, [&](const Position& p) {
      return Position{p[0] + push(random), p[1] + push(random), p[2] + push(random)};
    });
    const double expected = volume_by_jacobian(cell);
    const bool rational =
        shape_of(kind) == CellShape::pyramid || shape_of(kind) == CellShape::wedge;
    EXPECT_NEAR(figure(cell, volume), expected, (rational ? 2e-6 : 1e-13) * expected)
        << kind_name(kind);
    EXPECT_NEAR(figure(moved(cell, anywhere), volume), expected * std::pow(0.37, 3),
                (rational ? 2e-6 : 1e-12) * expected)
        << kind_name(kind);
    EXPECT_GT(std::abs(expected - volume_by_jacobian(one_cell(kind, std::identity()))), 1e-4);
    for (std::size_t f = 0; f < kFigureCount; ++f) {
      const auto of = static_cast<QualityFigure>(f);
      if (has_figure(kind, of)) {
        EXPECT_TRUE(std::isfinite(figure(cell, of))) << kind_name(kind) << description_of(of).key;
      }
    }
  }
}

/// x -> x (1 + x / 2): the determinant of the map is 1 + x, from 1 to 2 over the brick.
TEST(CellQuality, TheJacobianRatioOfAStretchedBrick) {
  const ZooMesh cell = moved(one_cell(CellKind::brick20,
                                      [](const Position& p) {
                                        return Position{p[0] * (1 + p[0] / 2), p[1], p[2]};
                                      }),
                             anywhere);
  EXPECT_NEAR(figure(cell, jacobian_ratio), 0.5, 1e-12);
}

}  // namespace
}  // namespace hiac::test
