#include "hiac/preview/regions/sheets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/preview/convex_polyhedra.hpp"

namespace hiac::preview {
namespace {

Polyhedron polyhedron_of(const test::HullPolyhedron& hull) {
  Polyhedron result;
  result.clear();
  for (const auto& corner : hull.corners) {
    result.camera.push_back(corner);
    result.shares.push_back({});
    result.points.push_back({corner[0], corner[1]});
    result.depths.push_back(corner[2]);
  }
  for (const auto& face : hull.faces) {
    result.corners.insert(result.corners.end(), face.begin(), face.end());
    result.first.push_back(static_cast<std::uint16_t>(result.corners.size()));
  }
  return result;
}

// Where the line along z through a point is inside all faces' planes.
std::array<double, 2> depths_at(const test::HullPolyhedron& hull, const ScreenPoint& p) {
  double front = -std::numeric_limits<double>::infinity(), back = -front;
  for (const auto& face : hull.faces) {
    const auto &a = hull.corners[face[0]], &b = hull.corners[face[1]], &c = hull.corners[face[2]];
    std::array<double, 3> n{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      n[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    }
    if (n[2] == 0) continue;
    const double depth = a[2] - (n[0] * (p.x - a[0]) + n[1] * (p.y - a[1])) / n[2];
    // outward normals
    if (n[2] < 0)
      front = std::max(front, depth);
    else
      back = std::min(back, depth);
  }
  return {front, back};
}

TEST(Sheets, AreTheLowerAndUpperHull) {
  std::mt19937_64 random(5);
  Subdivision subdivision;
  Sheets sheets;
  std::vector<RayThrough> rays;
  std::vector<PolyhedronEdge> edges;
  int found = 0, thick_rims = 0;
  for (int i = 0; i < 5000; ++i) {
    const test::HullPolyhedron hull = test::random_polyhedron(random, 4 + random() % 12, 7);
    const Polyhedron polyhedron = polyhedron_of(hull);
    edges_of(polyhedron, edges);
    subdivision.build(polyhedron.points, edges);
    sheets.find(polyhedron, edges, subdivision, rays);
    ASSERT_EQ(rays.size(), subdivision.vertices().size());
    for (const RayThrough& ray : rays) {
      const auto [front, back] = depths_at(hull, ray.at);
      ASSERT_NEAR(ray.front.depth, front, 1e-9) << i;
      ASSERT_NEAR(ray.back.depth, back, 1e-9) << i;
      for (const SurfacePoint& point : {ray.front, ray.back}) {
        ScreenPoint mean{0, 0};
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          mean.x += point.weights[k] * polyhedron.points[point.vertices[k]].x;
          mean.y += point.weights[k] * polyhedron.points[point.vertices[k]].y;
          sum += point.weights[k];
          ASSERT_GE(point.weights[k], 0);
        }
        ASSERT_NEAR(sum, 1, 1e-12);
        ASSERT_NEAR(mean.x, ray.at.x, 1e-9);
        ASSERT_NEAR(mean.y, ray.at.y, 1e-9);
      }
      ++found;
    }
    for (const std::uint32_t v : subdivision.outline())
      thick_rims += rays[v].back.depth > rays[v].front.depth ? 1 : 0;
  }
  EXPECT_GT(found, 50000);
  EXPECT_GT(thick_rims, 1000);  // walls seen edge-on
}

}  // namespace
}  // namespace hiac::preview
