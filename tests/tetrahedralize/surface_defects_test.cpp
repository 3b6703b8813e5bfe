#include "hiac/tetrahedralize/meshing/surface_defects.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include <gmock/gmock.h>

#include "tests/support/instrumented.hpp"
#include "tests/tetrahedralize/surfaces.hpp"

namespace hiac {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;
using Position = std::array<double, 3>;

Surface soup(std::vector<Position> points, const std::vector<std::array<std::uint32_t, 3>>& all) {
  Surface surface{std::move(points), {}, {}, {}};
  for (const auto& [a, b, c] : all) surface.facets.push_back({{{a, b, c}}, {}});
  return surface;
}

TEST(SurfaceDefects, ABoxHasNone) {
  EXPECT_TRUE(find_surface_defects(test::box_surface({0, 0, 0}, {1, 2, 3})).none());
}

TEST(SurfaceDefects, AMissingTriangleLeavesThreeOpenEdges) {
  Surface box = test::box_surface({0, 0, 0}, {1, 1, 1});
  box.facets.pop_back();
  const SurfaceDefects defects = find_surface_defects(box);
  EXPECT_EQ(defects.open.size(), 3U);
  EXPECT_THAT(defects.intersecting, IsEmpty());
  for (const auto& edge : defects.open) {
    const auto& polygon = box.facets[edge.triangle].polygons[0];
    for (const std::uint32_t point : edge.points) EXPECT_THAT(polygon, testing::Contains(point));
  }
}

// A box moved along x from one that it pierces until it only touches it, and one ulp away.
TEST(SurfaceDefects, BoxesThatTouchIntersectAndAnUlpApartDoNot) {
  const Surface still = test::box_surface({0, 0, 0}, {1, 1, 1});
  const auto beside = [&](double x) {
    return find_surface_defects(
        test::with(still, test::box_surface({x, 0.25, 0.25}, {x + 1, 0.75, 0.75})));
  };
  EXPECT_FALSE(beside(0.5).intersecting.empty());
  EXPECT_FALSE(beside(1).intersecting.empty());
  EXPECT_TRUE(beside(std::nextafter(1.0, 2.0)).none());
  EXPECT_TRUE(find_surface_defects(
                  test::with(still, test::box_surface({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5})))
                  .none());
}

TEST(SurfaceDefects, TrianglesThatShareCorners) {
  const std::vector<Position> points{{0, 0, 0},  {2, 0, 0},   {0, 2, 0},     {0, 0, 2},
                                     {1, 1, 0},  {-1, -1, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1},
                                     {-2, 0, 0}, {0, -2, 0}};
  const auto pairs = [&](const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    return find_surface_defects(soup(points, triangles)).intersecting;
  };
  // an edge in common: at an angle, in one plane on either side, folded onto one another
  EXPECT_THAT(pairs({{0, 1, 2}, {0, 1, 3}}), IsEmpty());
  EXPECT_THAT(pairs({{0, 1, 2}, {1, 0, 9}}), IsEmpty());
  EXPECT_THAT(pairs({{0, 1, 2}, {0, 1, 4}}), ElementsAre(Pair(0, 1)));
  // a corner in common: pointing away, piercing, along an edge
  EXPECT_THAT(pairs({{0, 1, 2}, {0, 8, 9}}), IsEmpty());
  EXPECT_THAT(pairs({{0, 1, 2}, {0, 6, 7}}), ElementsAre(Pair(0, 1)));
  EXPECT_THAT(pairs({{0, 1, 2}, {0, 4, 3}}), ElementsAre(Pair(0, 1)));
  // the same three
  EXPECT_THAT(pairs({{0, 1, 2}, {2, 0, 1}}), ElementsAre(Pair(0, 1)));
  // without area
  EXPECT_THAT(find_surface_defects(soup(points, {{5, 0, 4}})).degenerate, ElementsAre(0));
}

// In whole numbers, exactly: do two triangles without a common corner, neither of them flat, have
// a point in common? -----------------------------------------------------------------------------

using Whole = std::array<std::int64_t, 3>;
Whole minus(const Whole& a, const Whole& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Whole cross(const Whole& a, const Whole& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
std::int64_t dot(const Whole& a, const Whole& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// By separating axes, complete for convex bodies: normals, cross products of edges, and for
// coplanar triangles the edges' normals in their plane.
bool truly_intersect(const std::array<Whole, 3>& p, const std::array<Whole, 3>& q) {
  std::vector<Whole> axes;
  const auto edges = [](const std::array<Whole, 3>& t) {
    return std::array<Whole, 3>{minus(t[1], t[0]), minus(t[2], t[1]), minus(t[0], t[2])};
  };
  const Whole np = cross(edges(p)[0], edges(p)[1]), nq = cross(edges(q)[0], edges(q)[1]);
  axes.push_back(np);
  axes.push_back(nq);
  for (const Whole& e : edges(p)) {
    axes.push_back(cross(e, np));
    for (const Whole& f : edges(q)) axes.push_back(cross(e, f));
  }
  for (const Whole& f : edges(q)) axes.push_back(cross(f, nq));
  return std::ranges::none_of(axes, [&](const Whole& axis) {
    const auto range = [&](const std::array<Whole, 3>& t) {
      return std::minmax({dot(t[0], axis), dot(t[1], axis), dot(t[2], axis)});
    };
    const auto [p_low, p_high] = range(p);
    const auto [q_low, q_high] = range(q);
    return p_high < q_low || q_high < p_low;
  });
}

TEST(SurfaceDefects, RandomTrianglesAsWholeNumbersHaveIt) {
  std::mt19937_64 random(3);
  std::size_t met = 0, missed = 0;
  for (std::size_t trial = 0; trial < test::tried(3000); ++trial) {
    const std::int64_t side = trial % 2 == 0 ? 4 : 50;  // few values: many touch or are coplanar
    std::array<std::array<Whole, 3>, 2> t;
    std::vector<Position> points;
    for (auto& triangle : t)
      for (Whole& w : triangle) {
        for (std::int64_t& v : w) v = static_cast<std::int64_t>(random() % 1000) * side / 1000;
        points.push_back(
            {static_cast<double>(w[0]), static_cast<double>(w[1]), static_cast<double>(w[2])});
      }
    const auto flat = [](const std::array<Whole, 3>& c) {
      return cross(minus(c[1], c[0]), minus(c[2], c[0])) == Whole{0, 0, 0};
    };
    if (flat(t[0]) || flat(t[1])) continue;
    const bool truth = truly_intersect(t[0], t[1]);
    const auto defects = find_surface_defects(soup(points, {{0, 1, 2}, {3, 4, 5}}));
    EXPECT_EQ(!defects.intersecting.empty(), truth) << trial;
    ++(truth ? met : missed);
  }
  EXPECT_GT(met, 50U);
  EXPECT_GT(missed, 50U);
}

}  // namespace
}  // namespace hiac
