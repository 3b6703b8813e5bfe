#include "hiac/tetrahedralize/weld_surface.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>

namespace hiac {
namespace {

using Point = std::array<double, 3>;
using testing::ElementsAre;

double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// The same by looking at every pair.
std::vector<std::size_t> numbers_by_pairs(const std::vector<Point>& points, double tolerance) {
  std::vector<std::size_t> kept, numbers;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::size_t best = kept.size();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < kept.size(); ++k)
      if (const double d = distance(points[kept[k]], points[i]); d <= tolerance && d < least) {
        least = d;
        best = k;
      }
    numbers.push_back(best);
    if (best == kept.size()) kept.push_back(i);
  }
  return numbers;
}

TEST(WeldSurface, AgreesWithEveryPairOfPoints) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> coarse(-6, 6);
  std::uniform_real_distribution<double> fine(-0.4, 0.4);
  for (const double tolerance : {0.0, 0.1, 0.25, 0.7, 3.0}) {
    Surface surface;
    for (int i = 0; i < 400; ++i) {
      const double spread = i % 3 == 0 ? 0 : fine(random);
      surface.points.push_back({0.3 * coarse(random) + spread, 0.3 * coarse(random), -0.0});
      if (i % 2 == 0) surface.points.back()[2] = 0;
    }
    for (std::uint32_t i = 0; i + 2 < 400; ++i) surface.facets.push_back({{{i, i + 1, i + 2}}, {}});
    const Surface before = surface;
    const auto numbers = numbers_by_pairs(before.points, tolerance);
    const WeldCounts counts = weld_surface(surface, tolerance);
    EXPECT_EQ(counts.points, before.points.size() - surface.points.size());
    EXPECT_LE(counts.farthest, tolerance);
    std::size_t at = 0, gone = 0;
    for (const Facet& facet : before.facets) {
      const auto& t = facet.polygons[0];
      const std::size_t a = numbers[t[0]], b = numbers[t[1]], c = numbers[t[2]];
      if (a == b || b == c || c == a) {
        ++gone;
        continue;
      }
      ASSERT_LT(at, surface.facets.size());
      EXPECT_THAT(surface.facets[at++].polygons[0], ElementsAre(a, b, c));
    }
    EXPECT_EQ(at, surface.facets.size());
    EXPECT_EQ(gone, counts.facets);
  }
}

TEST(WeldSurface, PolygonsKeepTheCornersThatStayApart) {
  Surface surface;
  surface.points = {{0, 0, 0}, {1, 0, 0}, {1, 1e-6, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1e-6, 0}};
  surface.facets = {{{{0, 1, 2, 3, 4, 5}}, {}}};
  const WeldCounts counts = weld_surface(surface, 1e-5);
  EXPECT_EQ(counts.points, 2U);
  EXPECT_EQ(counts.facets, 0U);
  EXPECT_DOUBLE_EQ(counts.farthest, 1e-6);
  EXPECT_THAT(surface.facets[0].polygons[0], ElementsAre(0, 1, 2, 3));
}

}  // namespace
}  // namespace hiac
