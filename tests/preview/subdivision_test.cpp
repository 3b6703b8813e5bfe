#include "hiac/preview/regions/subdivision.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gmpxx.h>
#include <gtest/gtest.h>

#include "tests/preview/convex_polyhedra.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac::preview {
namespace {

using test::HullPolyhedron;

struct RationalPoint {
  mpq_class x, y;
  double near_x, near_y;
};

RationalPoint rational(const ScreenPoint& p) { return {p.x, p.y, p.x, p.y}; }

mpq_class area(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The sign of that: rational where doubles cannot tell. Points have coordinates up to 2^20.
int turn_at(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  const double l = (b.near_x - a.near_x) * (c.near_y - a.near_y);
  const double r = (b.near_y - a.near_y) * (c.near_x - a.near_x);
  const double size = std::abs(a.near_x) + std::abs(a.near_y) + std::abs(b.near_x) +
                      std::abs(b.near_y) + std::abs(c.near_x) + std::abs(c.near_y);
  if (std::abs(l - r) > 1e-13 * size * size) return l > r ? 1 : -1;
  return sgn(area(a, b, c));
}

RationalPoint crossing(const RationalPoint& c, const RationalPoint& d, const RationalPoint& e,
                       const RationalPoint& f) {
  const mpq_class n = area(e, f, c), m = area(e, f, d);
  const mpq_class t = n / (n - m);
  RationalPoint p{c.x + t * (d.x - c.x), c.y + t * (d.y - c.y), 0, 0};
  p.near_x = p.x.get_d();
  p.near_y = p.y.get_d();
  return p;
}

// Twice the area of a polygon, positive counter-clockwise.
mpq_class polygon_area(const std::vector<const RationalPoint*>& corners) {
  mpq_class sum = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const RationalPoint &a = *corners[k], &b = *corners[(k + 1) % corners.size()];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

// The area of the hull of the projected corners, found without the polyhedron's edges.
mpq_class silhouette_area(std::vector<ScreenPoint> points) {
  std::ranges::sort(points, [](const ScreenPoint& a, const ScreenPoint& b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  });
  std::vector<RationalPoint> all;
  for (const ScreenPoint& p : points) all.push_back(rational(p));
  mpq_class sum = 0;
  for (int half = 0; half < 2; ++half) {
    std::vector<const RationalPoint*> chain;
    for (const RationalPoint& p : all) {
      while (chain.size() > 1 && sgn(area(*chain[chain.size() - 2], *chain.back(), p)) <= 0)
        chain.pop_back();
      chain.push_back(&p);
    }
    for (std::size_t k = 0; k + 1 < chain.size(); ++k)
      sum += chain[k]->x * chain[k + 1]->y - chain[k]->y * chain[k + 1]->x;
    std::ranges::reverse(all);
  }
  return sum;
}

// Whether a segment passes through the inside of a convex polygon.
bool crosses(const RationalPoint& a, const RationalPoint& b,
             const std::vector<const RationalPoint*>& polygon) {
  bool left = false, right = false;
  std::vector<int> sides;
  for (const RationalPoint* corner : polygon) {
    sides.push_back(turn_at(a, b, *corner));
    left |= sides.back() > 0;
    right |= sides.back() < 0;
  }
  if (!left || !right) return false;
  // the line does: where it enters and leaves, in parts of the segment
  std::vector<mpq_class> places;
  const auto place = [&](const mpq_class& x, const mpq_class& y) {
    places.push_back(a.x != b.x ? mpq_class((x - a.x) / (b.x - a.x))
                                : mpq_class((y - a.y) / (b.y - a.y)));
  };
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const std::size_t next = (k + 1) % polygon.size();
    if (sides[k] == 0) place(polygon[k]->x, polygon[k]->y);
    if (sides[k] * sides[next] >= 0) continue;
    const RationalPoint p = crossing(*polygon[k], *polygon[next], a, b);
    place(p.x, p.y);
  }
  const auto [from, to] = std::ranges::minmax(places);
  return std::max(from, mpq_class(0)) < std::min(to, mpq_class(1));
}

struct Counts {
  std::size_t vertices = 0, edges = 0, regions = 0;
  bool operator==(const Counts&) const = default;
};

// Everything that can be said of a subdivision; a message where something is wrong.
std::string fault(const HullPolyhedron& polyhedron, Subdivision& subdivision) {
  const auto points = polyhedron.projected();
  const auto edges = polyhedron.edges();
  subdivision.build(points, edges);
  std::vector<RationalPoint> given, places;
  for (const ScreenPoint& p : points) given.push_back(rational(p));
  for (const Subdivision::Vertex& v : subdivision.vertices()) {
    if (v.point != Subdivision::kNone) {
      places.push_back(given[v.point]);
    } else {
      const auto &i = edges[v.edges[0]], &k = edges[v.edges[1]];
      places.push_back(crossing(given[i[0]], given[i[1]], given[k[0]], given[k[1]]));
    }
    const ScreenPoint rounded = subdivision.position(v);
    if (std::abs(rounded.x - places.back().near_x) > 1e-9 * (1 + std::abs(rounded.x)) ||
        std::abs(rounded.y - places.back().near_y) > 1e-9 * (1 + std::abs(rounded.y)))
      return "a vertex is in the wrong place";
  }
  mpq_class sum = 0;
  for (const Subdivision::Region& region : subdivision.regions()) {
    std::vector<const RationalPoint*> polygon;
    for (const std::uint32_t v : subdivision.corners().subspan(region.first, region.count))
      polygon.push_back(&places[v]);
    const mpq_class of_region = polygon_area(polygon);
    if (of_region <= 0) return "a region has no area";
    sum += of_region;
    for (std::size_t k = 0; k < polygon.size(); ++k)
      if (turn_at(*polygon[k], *polygon[(k + 1) % polygon.size()],
                  *polygon[(k + 2) % polygon.size()]) < 0)
        return "a region is not convex";
    for (const PolyhedronEdge& edge : edges)
      if (!(points[edge[0]] == points[edge[1]]) && crosses(given[edge[0]], given[edge[1]], polygon))
        return "an edge crosses a region";
  }
  const mpq_class silhouette = silhouette_area(points);
  if (sum != silhouette) return "the regions do not fill the silhouette";
  std::vector<const RationalPoint*> outline;
  for (const std::uint32_t v : subdivision.outline()) outline.push_back(&places[v]);
  if (-polygon_area(outline) != silhouette) return "the outline is not the silhouette";
  return {};
}

Counts counts_of(const Subdivision& subdivision) {
  Counts counts{subdivision.vertices().size(), 0, subdivision.regions().size()};
  counts.edges = (subdivision.corners().size() + subdivision.outline().size()) / 2;
  return counts;
}

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Traits = CGAL::Arr_segment_traits_2<Kernel>;

Counts counts_of_cgal(const HullPolyhedron& polyhedron) {
  CGAL::Arrangement_2<Traits> arrangement;
  const auto points = polyhedron.projected();
  std::vector<Traits::X_monotone_curve_2> segments;
  for (const PolyhedronEdge& e : polyhedron.edges())
    if (!(points[e[0]] == points[e[1]]))
      segments.emplace_back(Kernel::Point_2(points[e[0]].x, points[e[0]].y),
                            Kernel::Point_2(points[e[1]].x, points[e[1]].y));
  CGAL::insert(arrangement, segments.begin(), segments.end());
  return {arrangement.number_of_vertices(), arrangement.number_of_edges(),
          arrangement.number_of_faces() - arrangement.number_of_unbounded_faces()};
}

// Most polyhedra are small, some have up to 32 faces (18 points have at most 32 triangles).
HullPolyhedron polyhedron_number(int number, std::mt19937_64& random) {
  static constexpr unsigned kSides[] = {3, 4, 6, 0, 9, 1U << 20};
  const std::size_t points = number % 10 == 0 ? 14 + random() % 5 : 4 + random() % 6;
  return test::random_polyhedron(random, points, kSides[number % 6]);
}

TEST(Subdivision, FillsTheSilhouetteOfRandomPolyhedraExactly) {
  std::mt19937_64 random(2);
  Subdivision subdivision;
  std::size_t most_faces = 0, merged = 0, edge_on = 0;
  constexpr int kPolyhedra = test::kInstrumented ? 4000 : 100000;
  for (int i = 0; i < kPolyhedra; ++i) {
    const HullPolyhedron polyhedron = polyhedron_number(i, random);
    const std::string wrong = fault(polyhedron, subdivision);
    ASSERT_EQ(wrong, "") << "polyhedron " << i;
    most_faces = std::max(most_faces, polyhedron.faces.size());
    std::size_t lone = 0;
    for (const Subdivision::Vertex& v : subdivision.vertices())
      lone += v.point != Subdivision::kNone ? 1 : 0;
    merged += lone < polyhedron.corners.size() ? 1 : 0;
    for (const auto& face : polyhedron.faces) {
      const auto p = polyhedron.projected();
      edge_on += side(p[face[0]], p[face[1]], p[face[2]]) == 0 ? 1 : 0;
    }
  }
  // degenerate projections are not rare
  EXPECT_GE(most_faces, test::kInstrumented ? 20U : 28U);
  EXPECT_GT(merged, kPolyhedra / 10U);
  EXPECT_GT(edge_on, kPolyhedra / 10U);
}

TEST(Subdivision, HasTheVerticesEdgesAndRegionsOfCgalsArrangement) {
  std::mt19937_64 random(3);
  Subdivision subdivision;
  for (int i = 0; i < 3000; ++i) {
    const HullPolyhedron polyhedron = polyhedron_number(i, random);
    const auto points = polyhedron.projected();
    const auto edges = polyhedron.edges();
    subdivision.build(points, edges);
    const Counts found = counts_of(subdivision), truth = counts_of_cgal(polyhedron);
    ASSERT_EQ(found.vertices, truth.vertices) << "polyhedron " << i;
    ASSERT_EQ(found.edges, truth.edges) << "polyhedron " << i;
    ASSERT_EQ(found.regions, truth.regions) << "polyhedron " << i;
  }
}

TEST(Subdivision, DoesNotAskForConvexity) {
  // segments at random, connected by a path: what rounding may make of a polyhedron, and more
  std::mt19937_64 random(4);
  Subdivision subdivision;
  for (int i = 0; i < 500; ++i) {
    HullPolyhedron any;
    for (int k = 0; k < 8; ++k)
      any.corners.push_back({static_cast<double>(random() % 5), static_cast<double>(random() % 5),
                             static_cast<double>(k)});
    for (std::uint16_t k = 0; k + 1 < 8; ++k)
      any.faces.push_back({k, static_cast<std::uint16_t>(k + 1)});
    any.faces.push_back({0, 5});
    any.faces.push_back({2, 7});
    const auto points = any.projected();
    const auto edges = any.edges();
    subdivision.build(points, edges);
    ASSERT_EQ(counts_of(subdivision), counts_of_cgal(any)) << i;
  }
}

TEST(Subdivision, RefusesEdgesThatAreNotConnected) {
  const std::vector<ScreenPoint> points{{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  const std::vector<PolyhedronEdge> edges{{0, 1}, {2, 3}};
  Subdivision subdivision;
  EXPECT_THROW(subdivision.build(points, edges), std::invalid_argument);
}

}  // namespace
}  // namespace hiac::preview
