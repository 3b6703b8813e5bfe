#include "hiac/geometry/inverse_map.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

using Point = CellMap::Point;

constexpr std::array kLinearKinds{CellKind::tetrahedron4, CellKind::pyramid5, CellKind::prism6,
                                  CellKind::wedge7, CellKind::brick8};

template <typename Move>
std::vector<Point> moved_corners(CellKind kind, const Move& move) {
  std::vector<Point> corners;
  for (const Point& node : reference_nodes(kind)) corners.push_back(move(node));
  return corners;
}

// A convex combination of the reference corners, often near one of them.
template <typename Random>
Point random_inside(CellKind kind, Random& random) {
  std::exponential_distribution<double> exponential;
  std::uniform_real_distribution<double> power(1, 12);
  const double sharpness = power(random);
  Point xi{};
  double sum = 0;
  for (const Point& node : reference_nodes(kind)) {
    const double weight = std::pow(exponential(random), sharpness);
    sum += weight;
    for (std::size_t a = 0; a < 3; ++a) xi[a] += weight * node[a];
  }
  for (double& x : xi) x /= sum;
  return xi;
}

Point affine(const Point& p) {
  return {5 + 0.9 * p[0] + 0.35 * p[1] - 0.1 * p[2], -0.15 * p[0] + 0.8 * p[1] + 0.3 * p[2],
          0.2 * p[0] - 0.25 * p[1] + p[2]};
}
// A projective map: faces stay planar.
Point tapered(const Point& p) {
  const double w = 1 + 3 * p[2] + 0.5 * p[0] + p[1];
  const Point q = affine(p);
  return {q[0] / w, q[1] / w, q[2] / w};
}

double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST(InverseMap, KnowsAffineCells) {
  for (const CellKind kind : kLinearKinds) {
    EXPECT_TRUE(CellMap(kind, moved_corners(kind, affine)).affine()) << kind_name(kind);
    EXPECT_EQ(CellMap(kind, moved_corners(kind, tapered)).affine(), kind == CellKind::tetrahedron4)
        << kind_name(kind);
  }
}

// Corners of small cells far from the origin are rounded by more than 1e-14 of the cells' size.
TEST(InverseMap, KnowsAffineCellsWhoseCornersAreRounded) {
  for (const CellKind kind : kLinearKinds) {
    auto corners = moved_corners(kind, affine);
    for (Point& p : corners)
      for (double& x : p) x = 1 + 0x1p-10 * x;
    const CellMap map(kind, corners);
    EXPECT_TRUE(map.affine()) << kind_name(kind);
    EXPECT_LE(map.off_affine(), 0x1p-51) << kind_name(kind);
    corners[2][0] += 1e-14;  // ten times as much
    EXPECT_EQ(CellMap(kind, corners).affine(), kind == CellKind::tetrahedron4) << kind_name(kind);
  }
}

TEST(InverseMap, FindsReferencePointsFromAnyGuess) {
  std::mt19937_64 random(1);
  for (const CellKind kind : kLinearKinds)
    for (const auto& corners : {moved_corners(kind, affine), moved_corners(kind, tapered)}) {
      const CellMap map(kind, corners);
      for (int i = 0; i < 2000; ++i) {
        const Point xi = random_inside(kind, random), guess = random_inside(kind, random);
        const Point x = map.position(xi);
        const Point found = map.reference(x, guess);
        ASSERT_LE(distance(map.position(found), x), 1e-13) << kind_name(kind);
        ASSERT_LE(distance(found, xi), 1e-12) << kind_name(kind);
      }
    }
}

// A frustum that shrinks a thousandfold: Newton from the far end does not converge by itself.
TEST(InverseMap, StronglyTaperedCellsAreInverted) {
  std::mt19937_64 random(2);
  const auto spiky = [](const Point& p) {
    const double s = 1 - 0.999 * p[2];
    return Point{s * (p[0] - 0.3), s * (p[1] - 0.2), p[2] + 0.2 * p[0]};
  };
  for (const CellKind kind : {CellKind::brick8, CellKind::prism6}) {
    const CellMap map(kind, moved_corners(kind, spiky));
    for (int i = 0; i < 2000; ++i) {
      const Point xi = random_inside(kind, random), guess = random_inside(kind, random);
      const Point x = map.position(xi);
      ASSERT_LE(distance(map.position(map.reference(x, guess)), x), 1e-13) << kind_name(kind);
    }
  }
}

// Nodes between corners where straight edges have them change nothing, and are measured where not.
TEST(InverseMap, StraightCellsOfHigherOrderHaveTheMapOfTheirCorners) {
  std::mt19937_64 random(3);
  for (const CellKind kind : kLinearKinds)
    for (const CellOrder order : {CellOrder::quadratic, CellOrder::cubic}) {
      const CellKind higher = kind_of(shape_of(kind), order);
      const CellMap linear(kind, moved_corners(kind, tapered));
      std::vector<Point> nodes;
      for (const Point& node : reference_nodes(higher)) nodes.push_back(linear.position(node));
      const CellMap map(higher, nodes);
      EXPECT_TRUE(map.straight()) << kind_name(higher);
      for (int i = 0; i < 50; ++i) {
        const Point xi = random_inside(kind, random);
        EXPECT_EQ(map.position(xi), linear.position(xi));
      }
      nodes.back()[1] += 0.01;
      EXPECT_FALSE(CellMap(higher, nodes).straight());
      EXPECT_GT(edge_deviation(higher, nodes), 0.002);
      EXPECT_TRUE(CellMap(higher, nodes, 0.05).straight());
    }
}

// Every node off its place: all nodes make the map.
TEST(InverseMap, CurvedCellsAreInverted) {
  std::mt19937_64 random(4);
  const auto bent = [](const Point& p) {
    return Point{p[0] + 0.12 * std::sin(2 * p[1] + p[2]), p[1] + 0.1 * p[0] * p[2],
                 p[2] - 0.1 * std::cos(2 * p[0])};
  };
  for (const CellKind kind : kLinearKinds)
    for (const CellOrder order : {CellOrder::quadratic, CellOrder::cubic}) {
      const CellKind higher = kind_of(shape_of(kind), order);
      const CellMap map(higher, moved_corners(higher, bent));
      EXPECT_FALSE(map.straight());
      for (int i = 0; i < 1000; ++i) {
        const Point xi = random_inside(kind, random), guess = random_inside(kind, random);
        const Point x = map.position(xi), found = map.reference(x, guess);
        ASSERT_LE(distance(map.position(found), x), 1e-13) << kind_name(higher);
        ASSERT_LE(distance(found, xi), 1e-12) << kind_name(higher);
      }
    }
}

TEST(InverseMap, CornersAreFound) {
  for (const CellKind kind : kLinearKinds) {
    const auto corners = moved_corners(kind, tapered);
    const CellMap map(kind, corners);
    for (const Point& corner : corners)
      EXPECT_LE(distance(map.position(map.reference(corner, map.middle())), corner), 1e-14)
          << kind_name(kind);
  }
}

}  // namespace
}  // namespace hiac
