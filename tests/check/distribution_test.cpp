#include "hiac/check/quality/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "hiac/base/parallel.hpp"
#include "hiac/check/quality/mesh_quality.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::test {
namespace {

// By the definitions, on a sorted copy.
TEST(Distribution, AsDefined) {
  std::mt19937 random(3);
  for (const std::size_t count : {1U, 2U, 3U, 7U, 99U, 100U, 101U, 250U, 40'000U}) {
    std::vector<double> values(count);
    // many equal values, and some that are not defined
    for (double& value : values) {
      value = static_cast<double>(random() % 50) / 4 - 3;
      if (random() % 9 == 0) value = std::numeric_limits<double>::quiet_NaN();
    }
    std::vector<double> defined;
    for (const double value : values)
      if (!std::isnan(value)) defined.push_back(value);
    const std::vector<double> before = values, edges{-2, 0, 0.25, 5};
    const Distribution found = distribution_of(values, edges);
    EXPECT_EQ(found.count, defined.size());
    EXPECT_EQ(found.undefined, count - defined.size());
    if (defined.empty()) continue;
    double sum = 0;
    for (const double value : defined) sum += value;
    EXPECT_NEAR(found.mean, sum / static_cast<double>(defined.size()), 1e-12);
    std::ranges::sort(defined);
    EXPECT_EQ(found.least, defined.front());
    EXPECT_EQ(found.largest, defined.back());
    const auto first = [&](double value) {
      return static_cast<std::uint64_t>(std::ranges::find(before, value) - before.begin());
    };
    EXPECT_EQ(found.least_at, first(defined.front()));
    EXPECT_EQ(found.largest_at, first(defined.back()));
    for (std::size_t i = 0; i < kPercents.size(); ++i) {
      const std::set<double> different(defined.begin(), defined.end());
      const auto value = *std::ranges::find_if(different, [&](double v) {
        const auto lower = std::ranges::count_if(defined, [&](double w) { return w <= v; });
        return 100 * lower >= static_cast<std::ptrdiff_t>(kPercents[i] * defined.size());
      });
      EXPECT_EQ(found.percentiles[i], value) << kPercents[i] << " of " << count;
    }
    std::uint64_t total = 0;
    for (std::size_t i = 0; i <= edges.size(); ++i) {
      const double low = i == 0 ? -1e9 : edges[i - 1], high = i == edges.size() ? 1e9 : edges[i];
      EXPECT_EQ(found.histogram.counts[i],
                std::ranges::count_if(defined, [&](double v) { return v >= low && v < high; }));
      total += found.histogram.counts[i];
    }
    EXPECT_EQ(total, defined.size());
  }
}

TEST(Distribution, OfNothing) {
  std::vector<double> none, undefined{std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(distribution_of(none, std::vector<double>{0}).count, 0U);
  EXPECT_EQ(distribution_of(undefined, std::vector<double>{0}).undefined, 1U);
}

TEST(MeshQuality, NamesCellsByTheirNumbersInTheMesh) {
  // six tetrahedra, then eight bricks, one of them twice as long, then a larger one
  ZooMesh mesh = side_by_side(structured(1, Cut::tetrahedra), structured(2, Cut::bricks));
  mesh = side_by_side(mesh, moved(structured(1, Cut::bricks), [](const Position& p) {
                        return Position{p[0] + 2, p[1], 4 * p[2]};
                      }));
  const auto quality = mesh_quality(mesh, 1);
  ASSERT_EQ(quality.size(), 2U);
  EXPECT_EQ(quality[0].kind, CellKind::tetrahedron4);
  EXPECT_NEAR(quality[0].volume, 1, 1e-14);
  EXPECT_EQ(quality[0].figures.size(), kFigureCount - 1);
  EXPECT_EQ(quality[1].cells, 9U);
  EXPECT_NEAR(quality[1].volume, 1 + 4, 1e-14);
  EXPECT_EQ(quality[1].figures.size(), kFigureCount - 2);
  const Distribution& volumes = quality[1].figures[0].distribution;
  EXPECT_EQ(volumes.least_at, 6U);
  EXPECT_EQ(volumes.largest_at, 14U);
  EXPECT_EQ(volumes.percentiles[3], 0.125);
  EXPECT_EQ(volumes.largest, 4);
  // the mean is 5 / 9: eight cells are a quarter of it or less, one is seven times as large
  EXPECT_EQ(volumes.histogram.counts[5], 8U);
  EXPECT_EQ(volumes.histogram.counts[12], 1U);
}

TEST(MeshQuality, DoesNotDependOnTheNumberOfThreads) {
  const ZooMesh mesh = random_delaunay(3000, 4);
  const ThreadLimit one(1);
  const auto alone = mesh_quality(mesh, 1);
  const ThreadLimit four(4);
  const auto together = mesh_quality(mesh, 1);
  for (std::size_t f = 0; f < alone[0].figures.size(); ++f) {
    const Distribution &a = alone[0].figures[f].distribution,
                       &b = together[0].figures[f].distribution;
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.least_at, b.least_at);
    EXPECT_EQ(a.percentiles, b.percentiles);
    EXPECT_EQ(a.histogram.counts, b.histogram.counts);
  }
}

}  // namespace
}  // namespace hiac::test
