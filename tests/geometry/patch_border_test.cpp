#include "hiac/geometry/patch_border.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/geometry/patch_shapes.hpp"

namespace hiac {
namespace {

constexpr double kRounding = 1e-10;

using Parameter = std::array<double, 2>;
using Linear = std::array<double, 3>;  // the coefficients of 1, u and v

struct Seen {
  PatchShape shape;
  PatchNet<double> a{}, b{}, depth{};

  [[nodiscard]] PatchAndRay question() const { return {shape, a, b, depth, kRounding}; }
  [[nodiscard]] std::size_t at(std::size_t i, std::size_t j) const {
    return i + (shape.degree + 1U) * j;
  }
  [[nodiscard]] double value(const PatchNet<double>& net, const Parameter& p) const {
    const std::size_t n = shape.degree;
    return evaluate_patch(n, net, BernsteinValues(n, p[0]), BernsteinValues(n, p[1])).value;
  }
  [[nodiscard]] Parameter corner(std::size_t k) const {
    constexpr std::array<Parameter, 4> kSquare{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    constexpr std::array<Parameter, 3> kTriangle{{{0, 0}, {1, 0}, {0, 1}}};
    return shape.triangle ? kTriangle[k % 3] : kSquare[k % 4];
  }
  [[nodiscard]] Parameter on_edge(std::size_t k, double s) const {
    const auto p = corner(k), q = corner(k + 1);
    return {p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])};
  }
};

// The control points of linear functions lie evenly.
void set(const Seen& seen, PatchNet<double>& net, const Linear& f) {
  const std::size_t n = seen.shape.degree;
  for (std::size_t j = 0; j <= n; ++j)
    for (std::size_t i = 0; i <= n; ++i)
      net[seen.at(i, j)] = f[0] + (f[1] * static_cast<double>(i) + f[2] * static_cast<double>(j)) /
                                      static_cast<double>(n);
}

Seen seen_as(const PatchShape& shape, const Linear& a, const Linear& b, const Linear& depth) {
  Seen seen{shape};
  set(seen, seen.a, a);
  set(seen, seen.b, b);
  set(seen, seen.depth, depth);
  return seen;
}

// A patch with bent edges, of which the point at s on edge k lies on the ray.
Seen with_edge_on_ray(const PatchShape& shape, std::size_t k, double s, std::mt19937& random) {
  std::uniform_real_distribution<double> bump(-0.12, 0.12);
  Seen seen = seen_as(shape, {0, 1, 0.2}, {0, -0.1, 1}, {0, 1, 1});
  for (PatchNet<double>* net : {&seen.a, &seen.b}) {
    for (double& c : *net) c += bump(random);
    const double off = seen.value(*net, seen.on_edge(k, s));
    for (double& c : *net) c -= off;
  }
  return seen;
}

TEST(PatchBorder, ThePointOfABentEdgeThatLiesOnTheRayIsFound) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(0, 1);
  for (const PatchShape& shape : test::kPatchShapes)
    for (std::size_t k = 0; k < shape.corner_count(); ++k)
      for (int i = 0; i < 30; ++i) {
        const double s = i == 0 ? 0 : i == 1 ? 1 : number(random);
        const Seen seen = with_edge_on_ray(shape, k, s, random);
        const Parameter expected = seen.on_edge(k, s);
        const BorderPlace found = least_deep_on_border(seen.question());
        EXPECT_NEAR(found.u, expected[0], 1e-9)
            << int{shape.degree} << " edge " << k << " at " << s;
        EXPECT_NEAR(found.v, expected[1], 1e-9);
        EXPECT_LE(found.off, kRounding);
        // from a point beside it, outside the domain or inside
        const BorderPlace near =
            nearest_on_border(seen.question(), expected[0] + 0.1 * (number(random) - 0.5),
                              expected[1] + 0.1 * (number(random) - 0.5));
        EXPECT_NEAR(near.u, expected[0], 1e-9) << int{shape.degree} << " edge " << k << " at " << s;
        EXPECT_NEAR(near.v, expected[1], 1e-9);
        EXPECT_LE(near.off, kRounding);
      }
}

// Of each straight edge the nearest point is that of a segment in the plane; of all edges' points,
// the one with the lesser larger coordinate counts.
TEST(PatchBorder, StraightEdgesAreSegmentsInThePlane) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const bool triangle : {false, true})
    for (int i = 0; i < 200; ++i) {
      Seen seen{{1, triangle, false}};
      for (PatchNet<double>* net : {&seen.a, &seen.b}) {
        for (double& c : *net) c = number(random);
        if (triangle) (*net)[3] = (*net)[1] + (*net)[2] - (*net)[0];
      }
      double least = INFINITY;
      Parameter expected{};
      const auto include = [&](std::size_t k, double s) {
        const Parameter p = seen.on_edge(k, s);
        const double off =
            std::max(std::abs(seen.value(seen.a, p)), std::abs(seen.value(seen.b, p)));
        if (off < least) {
          least = off;
          expected = p;
        }
      };
      for (std::size_t k = 0; k < seen.shape.corner_count(); ++k) {
        const Parameter p = seen.corner(k), q = seen.corner(k + 1);
        const double a0 = seen.value(seen.a, p), a = seen.value(seen.a, q) - a0;
        const double b0 = seen.value(seen.b, p), b = seen.value(seen.b, q) - b0;
        include(k, 0);
        include(k, std::clamp(-(a0 * a + b0 * b) / (a * a + b * b), 0.0, 1.0));
      }
      const BorderPlace found = least_deep_on_border(seen.question());
      EXPECT_NEAR(found.off, least, 1e-12) << i;
      EXPECT_NEAR(found.u, expected[0], 1e-9) << i;
      EXPECT_NEAR(found.v, expected[1], 1e-9) << i;
    }
}

// A ray in the patch passes the border at (0, 0.1) and (0.9, 1) of a square, (0.45, 0.55) of a
// triangle.
TEST(PatchBorder, OfSeveralPointsOnTheRayTheLeastDeepOrTheNearestIsTaken) {
  for (const PatchShape& shape : test::kPatchShapes)
    for (const double away : {1.0, -1.0}) {
      const Seen seen = seen_as(shape, {0.1, 1, -1}, {0.2, 2, -2}, {2, away, 3 * away});
      const Parameter low{0, 0.1};
      const Parameter high = shape.triangle ? Parameter{0.45, 0.55} : Parameter{0.9, 1};
      const Parameter& least = away > 0 ? low : high;
      const BorderPlace found = least_deep_on_border(seen.question());
      EXPECT_NEAR(found.u, least[0], 1e-12) << int{shape.degree};
      EXPECT_NEAR(found.v, least[1], 1e-12);
      for (const Parameter& to : {low, high}) {
        const BorderPlace near =
            nearest_on_border(seen.question(), to[0] + 0.02 * away, to[1] + 0.02 * away);
        EXPECT_NEAR(near.u, to[0], 1e-12) << int{shape.degree};
        EXPECT_NEAR(near.v, to[1], 1e-12);
      }
    }
}

// A linear function that vanishes on edge k.
Linear vanishing_on(const PatchShape& shape, std::size_t k) {
  if (shape.triangle) return std::array<Linear, 3>{{{0, 0, 1}, {1, -1, -1}, {0, 1, 0}}}[k];
  return std::array<Linear, 4>{{{0, 0, 1}, {1, -1, 0}, {1, 0, -1}, {0, 1, 0}}}[k];
}

// The parameter along edge k.
Linear along(const PatchShape& shape, std::size_t k) {
  if (shape.triangle) return std::array<Linear, 3>{{{0, 1, 0}, {0, 0, 1}, {1, 0, -1}}}[k];
  return std::array<Linear, 4>{{{0, 1, 0}, {0, 0, 1}, {1, -1, 0}, {1, 0, -1}}}[k];
}

// Within a 64th of what rounding may do, a point of the border is as good as any nearer one.
TEST(PatchBorder, PointsThatAreOnTheRayStay) {
  constexpr double kStays = 0x1p-6 * kRounding;
  for (const PatchShape& shape : test::kPatchShapes)
    for (std::size_t k = 0; k < shape.corner_count(); ++k)
      for (const double by : {0.9 * kStays, -0.9 * kStays, 1.1 * kStays, -1.1 * kStays}) {
        Linear a = along(shape, k);
        a[0] -= 0.4;
        const Seen seen = seen_as(shape, a, vanishing_on(shape, k), {0, 1, 1});
        const Parameter from = seen.on_edge(k, 0.4 + by);
        const BorderPlace found = nearest_on_border(seen.question(), from[0], from[1]);
        const Parameter expected = std::abs(by) < kStays ? from : seen.on_edge(k, 0.4);
        EXPECT_NEAR(found.u, expected[0], 1e-15) << int{shape.degree} << " edge " << k << ' ' << by;
        EXPECT_NEAR(found.v, expected[1], 1e-15) << int{shape.degree} << " edge " << k << ' ' << by;
      }
}

TEST(PatchBorder, IsFoundWhereNumbersAreNone) {
  for (const PatchShape& shape : test::kPatchShapes) {
    Seen seen = seen_as(shape, {-0.3, 1, 0}, {-0.4, 0, 1}, {0, 1, 1});
    seen.a[0] = std::nan("");
    for (const BorderPlace& place :
         {least_deep_on_border(seen.question()), nearest_on_border(seen.question(), -0.1, 0.3),
          nearest_on_border(seen.question(), std::nan(""), std::nan(""))}) {
      EXPECT_GE(std::min(place.u, place.v), 0);
      EXPECT_LE(shape.triangle ? place.u + place.v : std::max(place.u, place.v), 1);
    }
  }
}

TEST(PatchBorder, ARayAlongAnEdgeIsAtItsLessDeepCorner) {
  for (const PatchShape& shape : test::kPatchShapes)
    for (std::size_t k = 0; k < shape.corner_count(); ++k)
      for (const Linear& depth : {Linear{0, 1, 3}, {0, -1, -3}, {0, 3, -1}}) {
        const Linear f = vanishing_on(shape, k);
        Seen seen = seen_as(shape, f, {-2 * f[0], -2 * f[1], -2 * f[2]}, depth);
        const Parameter from = seen.corner(k), to = seen.corner(k + 1);
        const auto depth_of = [&](const Parameter& p) { return depth[1] * p[0] + depth[2] * p[1]; };
        const Parameter& expected = depth_of(from) < depth_of(to) ? from : to;
        BorderPlace place{};
        ASSERT_TRUE(runs_along_edge(seen.question(), place)) << int{shape.degree} << " edge " << k;
        EXPECT_EQ(place.u, expected[0]) << int{shape.degree} << " edge " << k;
        EXPECT_EQ(place.v, expected[1]);
        EXPECT_EQ(place.off, 0);
        // an end of the edge beside the ray
        for (const Parameter& end : {from, to})
          for (PatchNet<double>* net : {&seen.a, &seen.b}) {
            const std::size_t n = shape.degree;
            double& c = (*net)[seen.at(end[0] == 1 ? n : 0, end[1] == 1 ? n : 0)];
            for (const double by : {0.99 * kRounding, -0.99 * kRounding}) {
              c += by;
              EXPECT_TRUE(runs_along_edge(seen.question(), place));
              c -= by;
            }
            for (const double by : {2 * kRounding, -2 * kRounding}) {
              c += by;
              EXPECT_FALSE(runs_along_edge(seen.question(), place));
              c -= by;
            }
          }
      }
}

// Between its corners an edge may leave the ray, at a third of its length alone.
TEST(PatchBorder, ARayThatABentEdgeLeavesDoesNotRunAlongIt) {
  const std::array<std::vector<std::vector<double>>, 4> profiles{
      {{}, {}, {{0, 2, 0}}, {{0, 3, -1.5, 0}, {0, -1.5, 3, 0}}}};  // 1 at a point, 0 at others
  for (const PatchShape& shape : test::kPatchShapes)
    for (std::size_t k = 0; k < shape.corner_count(); ++k) {
      if (shape.triangle && k == 1) continue;  // no line of control points
      const std::size_t n = shape.degree;
      for (const std::vector<double>& profile : profiles[n])
        for (const bool sideways : {true, false})
          for (const double height : {0.99, -0.99, 1.01, -1.01}) {
            const Linear f = vanishing_on(shape, k);
            Seen seen = seen_as(shape, f, f, {0, 1, 1});
            for (std::size_t i = 0; i <= n; ++i) {
              const bool along_u = f[1] == 0;
              const std::size_t across = f[0] == 0 ? 0 : n;
              const std::size_t at = along_u ? seen.at(i, across) : seen.at(across, i);
              (sideways ? seen.a : seen.b)[at] += height * kRounding * profile[i];
            }
            BorderPlace place{};
            EXPECT_EQ(runs_along_edge(seen.question(), place), std::abs(height) < 1)
                << n << " edge " << k << " height " << height;
          }
    }
}

TEST(PatchBorder, ARayInAllOfAPatchIsAtItsLeastDeepCorner) {
  for (const PatchShape& shape : test::kPatchShapes)
    for (std::size_t k = 0; k < shape.corner_count(); ++k) {
      Seen seen{shape};
      seen.depth.fill(2);
      const Parameter corner = seen.corner(k);
      const std::size_t n = shape.degree;
      seen.depth[seen.at(corner[0] == 1 ? n : 0, corner[1] == 1 ? n : 0)] = 1;
      BorderPlace place{};
      ASSERT_TRUE(runs_along_edge(seen.question(), place));
      EXPECT_EQ(place.u, corner[0]);
      EXPECT_EQ(place.v, corner[1]);
    }
}

// Control points on a line of the plane, one of them beside it.
TEST(PatchBorder, APatchIsSeenEdgeOnWhereItsControlPointsLieOnALine) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const PatchShape& shape : test::kPatchShapes)
    for (const double turn : {0.0, 0.5, 1.5707963267948966, 2.0, 4.0}) {
      const double along_a = std::cos(turn), along_b = std::sin(turn);
      Seen seen{shape};
      for (std::size_t k = 0; k < shape.control_count(); ++k) {
        const double along = k == 0 ? 0.2 : k == 1 ? 3 : number(random);
        seen.a[k] = 0.7 + along * along_a;
        seen.b[k] = -0.4 + along * along_b;
      }
      EXPECT_TRUE(is_edge_on(seen.question())) << int{shape.degree} << ' ' << turn;
      for (std::size_t k = 2; k < shape.control_count(); ++k)
        for (const double by : {0.99, -0.99, 1.01, -1.01}) {
          Seen beside = seen;
          beside.a[k] -= by * kRounding * along_b;
          beside.b[k] += by * kRounding * along_a;
          EXPECT_EQ(is_edge_on(beside.question()), std::abs(by) < 1)
              << int{shape.degree} << ' ' << turn << " control point " << k << " by " << by;
        }
    }
}

}  // namespace
}  // namespace hiac
