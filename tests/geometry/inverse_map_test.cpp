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

// Every node between corners is measured from its place on the straight edge, or in the straight
// face, by its largest coordinate, and by the largest distance of a corner from the first one.
TEST(InverseMap, EdgeDeviationIsTheLargestOffsetOfANode) {
  for (const CellKind kind : kLinearKinds)
    for (const CellOrder order : {CellOrder::quadratic, CellOrder::cubic}) {
      const CellKind higher = kind_of(shape_of(kind), order);
      // thirds of the coordinates are whole numbers; corners are 48 apart at most
      std::vector<Point> nodes;
      for (const Point& node : reference_nodes(higher))
        nodes.push_back({24 * node[0] + 1, 48 * node[1] - 3, 12 * node[2] + 2});
      EXPECT_NEAR(edge_deviation(higher, nodes), 0, 1e-15) << kind_name(higher);
      for (std::size_t k = corner_count(kind); k < nodes.size(); ++k)
        for (std::size_t c = 0; c < 3; ++c)
          for (const double by : {3.0, -3.0}) {
            auto moved = nodes;
            moved[k][c] += by;
            moved[k][(c + 1) % 3] += 0.5 * by;
            constexpr double kSize = 48;
            EXPECT_NEAR(edge_deviation(higher, moved), 3 / kSize, 1e-15)
                << kind_name(higher) << " node " << k;
            const CellMap map(higher, moved, 0.1);
            EXPECT_TRUE(map.straight());
            EXPECT_NEAR(map.straightened(), 4 * 3, 1e-13);
            EXPECT_FALSE(CellMap(higher, moved, 0.99 * 3 / kSize).straight());
            EXPECT_TRUE(CellMap(higher, moved, 1.01 * 3 / kSize).straight());
          }
    }
  for (const CellKind kind : kLinearKinds)
    EXPECT_EQ(edge_deviation(kind, moved_corners(kind, tapered)), 0);
}

// The inverse of the Jacobian, by central differences of the map; its steepest row.
TEST(InverseMap, TheInverseInTheMiddleIsThatOfTheMap) {
  const auto bent = [](const Point& p) {
    return Point{p[0] + 0.12 * std::sin(2 * p[1] + p[2]), p[1] + 0.1 * p[0] * p[2],
                 p[2] - 0.1 * std::cos(2 * p[0])};
  };
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    for (const bool curved : {false, true}) {
      const CellMap map(kind, curved ? moved_corners(kind, bent) : moved_corners(kind, affine));
      const Point middle = map.middle();
      Point mean{};
      for (std::size_t c = 0; c < corner_count(kind); ++c)
        for (std::size_t a = 0; a < 3; ++a)
          mean[a] += reference_nodes(kind)[c][a] / static_cast<double>(corner_count(kind));
      EXPECT_LE(distance(middle, mean), 1e-15);
      double steepest = 0;
      for (std::size_t row = 0; row < 3; ++row) {
        const Point& r = map.inverse_in_middle()[row];
        steepest = std::max(steepest, std::hypot(r[0], r[1], r[2]));
        for (std::size_t a = 0; a < 3; ++a) {
          constexpr double kStep = 1e-5;
          Point before = middle, after = middle;
          before[a] -= kStep;
          after[a] += kStep;
          const Point x = map.position(before), y = map.position(after);
          double product = 0;
          for (std::size_t c = 0; c < 3; ++c) product += r[c] * (y[c] - x[c]) / (2 * kStep);
          EXPECT_NEAR(product, a == row ? 1 : 0, 1e-8) << kind_name(kind) << ' ' << curved;
        }
      }
      EXPECT_DOUBLE_EQ(map.steepness(), steepest);
    }
  }
}

}  // namespace
}  // namespace hiac
