#include "hiac/order/gaps/face_obstruction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace hiac::test {
namespace {

using Real = long double;
using Vec = std::array<Real, 3>;
using Corners = std::array<std::array<double, 3>, 4>;

Real dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec unit(const Vec& v) {
  const Real length = std::sqrt(dot(v, v));
  return {v[0] / length, v[1] / length, v[2] / length};
}

SeenFace seen(const Corners& p, std::size_t count, const View& view) {
  SeenFace face{{p[0].data(), p[1].data(), p[2].data(), p[3].data()}, count, 0};
  face.winding = view.perspective ? orientation(p[0], p[1], p[2], view.eye)
                                  : -orientation_towards(p[0], p[1], p[2], view.direction);
  return face;
}

Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec vec(Point3 p) { return {p[0], p[1], p[2]}; }

// The ray through a point.
Vec ray_through(const View& view, const Vec& p) {
  return view.perspective ? minus(p, vec(view.eye)) : vec(view.direction);
}

std::vector<Vec> polygon_of(const SeenFace& face) {
  std::vector<Vec> corners;
  for (std::size_t k = 0; k < face.count; ++k) corners.push_back(vec(face.corner(k)));
  return corners;
}

// The part of a polygon that is seen where `cover` is: on the inner side of the plane through the
// eye and each of its edges.
std::vector<Vec> common_part(std::vector<Vec> polygon, const SeenFace& cover, const View& view) {
  for (std::size_t e = 0; e < cover.count; ++e) {
    const Vec a = vec(cover.corner(e)), b = vec(cover.corner(e + 1));
    const Vec normal = unit(cross(ray_through(view, a), minus(b, a)));
    const auto height = [&](const Vec& p) { return -cover.winding * dot(normal, minus(p, a)); };
    std::vector<Vec> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
      const Real hp = height(p), hq = height(q);
      if (hp >= 0) kept.push_back(p);
      if ((hp < 0) == (hq < 0)) continue;
      const Real u = hp / (hp - hq);
      kept.push_back(
          {p[0] + u * (q[0] - p[0]), p[1] + u * (q[1] - p[1]), p[2] + u * (q[2] - p[2])});
    }
    polygon = std::move(kept);
  }
  return polygon;
}

Vec area_vector(const std::vector<Vec>& polygon) {
  Vec sum{};
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Vec part = cross(minus(polygon[k], polygon[0]), minus(polygon[k + 1], polygon[0]));
    for (std::size_t c = 0; c < 3; ++c) sum[c] += part[c] / 2;
  }
  return sum;
}

// How far beyond p, along the ray through it, the plane of a face is; as a multiple of the ray.
Real distance_beyond(const Vec& p, const std::vector<Vec>& face, const View& view) {
  const Vec normal = cross(minus(face[1], face[0]), minus(face[2], face[0]));
  return dot(normal, minus(face[0], p)) / dot(normal, ray_through(view, p));
}

struct Truth {
  bool certain = false;  // rounding cannot have decided
  bool overlap = false;
  bool pierce = false;  // each is in front of the other somewhere
  bool first_is_nearer = false;
};

Truth truth_of(const SeenFace& f, const SeenFace& g, const View& view) {
  const auto common = common_part(polygon_of(f), g, view);
  const Vec area = area_vector(common);
  Truth truth;
  truth.overlap = std::sqrt(dot(area, area)) > 1e-6L;
  truth.certain = truth.overlap || common.empty();
  if (!truth.overlap) return truth;
  Real least = 1e30L, most = -1e30L;
  for (const Vec& p : common) {
    const Real beyond = distance_beyond(p, polygon_of(g), view);
    least = std::min(least, beyond);
    most = std::max(most, beyond);
  }
  truth.pierce = least < -1e-12L && most > 1e-12L;
  truth.first_is_nearer = least + most > 0;
  return truth;
}

// A random triangle, or a parallelogram with coordinates that keep it planar to the last bit.
Corners random_face(std::mt19937_64& random, std::size_t count) {
  std::uniform_int_distribution<int> number(-1024, 1024);
  Corners p;
  for (auto& corner : p)
    for (double& x : corner) x = number(random) / 1024.0;
  if (count == 4)
    for (std::size_t c = 0; c < 3; ++c) p[3][c] = p[0][c] + p[2][c] - p[1][c];
  return p;
}

void expect_truth(const View& view, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  int overlapping = 0, apart = 0, piercing = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::size_t f_count = 3 + random() % 2, g_count = 3 + random() % 2;
    const Corners f_corners = random_face(random, f_count),
                  g_corners = random_face(random, g_count);
    const SeenFace f = seen(f_corners, f_count, view), g = seen(g_corners, g_count, view);
    if (f.winding == 0 || g.winding == 0) continue;
    const Truth truth = truth_of(f, g, view);
    if (!truth.certain) continue;
    ++(truth.overlap ? overlapping : apart);
    ASSERT_EQ(projections_overlap(f, g, view), truth.overlap) << "pair " << i;
    ASSERT_EQ(projections_overlap(g, f, view), truth.overlap) << "pair " << i;
    if (!truth.overlap) continue;
    piercing += truth.pierce ? 1 : 0;
    ASSERT_EQ(reached_first(f, g, view, 0), truth.pierce || truth.first_is_nearer) << "pair " << i;
    ASSERT_EQ(reached_first(g, f, view, 0), truth.pierce || !truth.first_is_nearer) << "pair " << i;
  }
  EXPECT_GT(overlapping, 1000);
  EXPECT_GT(apart, 1000);
  EXPECT_GT(piercing, 300);
}

TEST(FaceObstruction, FromOutside) { expect_truth({true, {-2.5, -1.5, 1.25}, {}}, 1); }

// Faces all round the eye, and many so near that they fill most of a hemisphere.
TEST(FaceObstruction, FromInside) { expect_truth({true, {0.125, -0.0625, 0.25}, {}}, 2); }

TEST(FaceObstruction, Orthographic) { expect_truth({false, {}, {0.5, -0.25, 1}}, 3); }

TEST(FaceObstruction, OrthographicAlongAnAxis) { expect_truth({false, {}, {0, 0, 1}}, 4); }

// Seen along z, f is the lower one; a little in front of it counts as touching.
TEST(FaceObstruction, FacesThatTouchAreMetInEitherOrder) {
  const View view{false, {}, {0, 0, 1}};
  const Corners p{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  Corners q = p;
  for (auto& corner : q) corner[0] += 0.25;
  const SeenFace f = seen(p, 4, view);
  EXPECT_TRUE(projections_overlap(f, seen(q, 4, view), view));
  EXPECT_TRUE(reached_first(f, seen(q, 4, view), view, 0));
  EXPECT_TRUE(reached_first(seen(q, 4, view), f, view, 0));
  for (auto& corner : q) corner[2] -= 1e-6;
  EXPECT_FALSE(reached_first(f, seen(q, 4, view), view, 0));
  EXPECT_TRUE(reached_first(f, seen(q, 4, view), view, 2e-6));
}

// Two squares seen along z, g tilted: its left part is behind f and its right part in front; in the
// middle they pierce each other, or a hair from an edge.
TEST(FaceObstruction, FacesThatPierceByLessThanTheSlackAreInOneOrder) {
  const View view{false, {}, {0, 0, 1}};
  const Corners p{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  for (const double at : {0.5, 1e-6, 1 - 1e-6}) {
    const Corners q{{{0, 0.25, at}, {1, 0.25, at - 1}, {1, 0.75, at - 1}, {0, 0.75, at}}};
    const SeenFace f = seen(p, 4, view), g = seen(q, 4, view);
    EXPECT_TRUE(reached_first(f, g, view, 0));
    EXPECT_TRUE(reached_first(g, f, view, 0));
    EXPECT_EQ(reached_first(f, g, view, 2e-6), at > 0.1);
    EXPECT_EQ(reached_first(g, f, view, 2e-6), at < 0.9);
  }
}

// Faces that share an edge or a corner on the screen, and nothing more, hide nothing of each other.
TEST(FaceObstruction, FacesThatMeetInAnEdgeDoNotOverlap) {
  const View view{true, {0.5, 0.5, -3}, {}};
  const Corners p{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {}}},
      q{{{1, 0, 0}, {0, 1, 0}, {1, 1, 0.5}, {}}};
  EXPECT_FALSE(projections_overlap(seen(p, 3, view), seen(q, 3, view), view));
}

}  // namespace
}  // namespace hiac::test
