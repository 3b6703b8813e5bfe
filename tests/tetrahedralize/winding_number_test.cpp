#include "hiac/tetrahedralize/winding_number.hpp"

#include <cmath>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/instrumented.hpp"
#include "tests/tetrahedralize/nested_shells.hpp"

namespace hiac {
namespace {

using Point = std::array<double, 3>;
using Wide = __int128;
using Whole = std::array<std::int64_t, 3>;

Wide det(const Whole& a, const Whole& b, const Whole& c) {
  const auto minor = [&](std::size_t i, std::size_t j) {
    return Wide{b[i]} * c[j] - Wide{b[j]} * c[i];
  };
  return a[0] * minor(1, 2) - a[1] * minor(0, 2) + a[2] * minor(0, 1);
}
Whole minus(const Whole& a, const Whole& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// By a ray in that direction, in whole numbers; none where it meets an edge or a corner.
std::optional<int> winding_along(const Surface& surface, const Whole& p, const Whole& direction) {
  const auto sign = [](Wide x) { return (x > 0) - (x < 0); };
  int winding = 0;
  for (const Facet& facet : surface.facets) {
    std::array<Whole, 3> t{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        t[k][c] = static_cast<std::int64_t>(surface.points[facet.polygons[0][k]][c]);
    std::array<int, 3> sides{};
    for (std::size_t k = 0; k < 3; ++k)
      sides[k] = sign(det(direction, minus(t[k], p), minus(t[(k + 1) % 3], p)));
    const auto [low, high] = std::minmax({sides[0], sides[1], sides[2]});
    if (low < 0 && high > 0) continue;
    // through all of the triangle, which is ahead or behind, or past it in its plane
    const int turn = sign(det(minus(t[1], t[0]), minus(t[2], t[0]), direction));
    const int behind = sign(det(minus(t[1], t[0]), minus(t[2], t[0]), minus(p, t[0])));
    if (turn == 0 || low == 0 || high == 0) return std::nullopt;
    if (behind == -turn) winding += turn;
  }
  return winding;
}

TEST(WindingNumber, OfRandomShellsIsThatOfTheShellsAroundAPoint) {
  std::mt19937_64 random(11);
  std::size_t negative = 0, empty = 0, several = 0, by_rays = 0;
  for (std::size_t trial = 0; trial < test::tried(60); ++trial) {
    const test::NestedShells nested = test::nested_shells(true, random);
    EXPECT_EQ(surface_orientation(nested.surface).opposed_edges, 0U);
    EXPECT_EQ(surface_orientation(nested.surface).single_shell, nested.shells.size() == 1);
    for (int sample = 0; sample < 40; ++sample) {
      // whole numbers: most rays along an axis meet corners, edges or faces in their plane
      const Whole whole{static_cast<std::int64_t>(random() % 66) - 1,
                        static_cast<std::int64_t>(random() % 66) - 1,
                        static_cast<std::int64_t>(random() % 66) - 1};
      const Point p{static_cast<double>(whole[0]), static_cast<double>(whole[1]),
                    static_cast<double>(whole[2])};
      if (std::ranges::any_of(nested.shells, [&](const auto& s) { return s.side(p) == 0; }))
        continue;
      const int found = winding_number(nested.surface, p);
      ASSERT_EQ(found, nested.winding(p)) << p[0] << " " << p[1] << " " << p[2];
      if (const auto truth = winding_along(nested.surface, whole, {1009, -2003, 3001})) {
        ASSERT_EQ(found, *truth);
        ++by_rays;
      }
      negative += found < 0 ? 1 : 0;
      several += found > 1 ? 1 : 0;
      empty += found == 0 && nested.shells.front().side(p) > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(negative, test::tried(20));
  EXPECT_GT(several, test::tried(20));
  EXPECT_GT(empty, test::tried(20));
  EXPECT_GT(by_rays, test::tried(100));
}

// The last bit decides: points one ulp to either side of a tilted face.
TEST(WindingNumber, IsExactBesideAFace) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(0, 1);
  for (std::size_t trial = 0; trial < test::tried(300); ++trial) {
    const double scale = std::ldexp(1, static_cast<int>(trial % 5) * 200 - 400);
    Surface shell;
    shell.points = {{0, 0, 0}, {scale, 0, 0}, {0, scale, 0}, {0, 0, scale}};
    for (const auto& [a, b, c] : {std::array{0U, 2U, 1U}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
      shell.facets.push_back({{{a, b, c}}, {}});
    Point p{0, scale * any(random) / 4, scale * any(random) / 4};
    // y and z with few bits, so that the face is met at a double
    for (const std::size_t c : {std::size_t{1}, std::size_t{2}})
      p[c] = std::ldexp(std::floor(std::ldexp(p[c] / scale, 20)), -20) * scale;
    p[0] = scale - p[1] - p[2];
    Point inside = p, outside = p;
    inside[0] = std::nextafter(p[0], 0.0);
    outside[0] = std::nextafter(p[0], 2 * scale);
    if (p[1] == 0 || p[2] == 0) continue;
    EXPECT_EQ(winding_number(shell, inside), 1) << trial;
    EXPECT_EQ(winding_number(shell, outside), 0) << trial;
  }
}

TEST(SurfaceOrientation, FindsTrianglesThatDoNotAgree) {
  Surface box = test::box_surface({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(surface_orientation(box).opposed_edges, 0U);
  EXPECT_TRUE(surface_orientation(box).single_shell);
  std::swap(box.facets[3].polygons[0][0], box.facets[3].polygons[0][1]);
  EXPECT_EQ(surface_orientation(box).opposed_edges, 3U);
  EXPECT_TRUE(surface_orientation(box).single_shell);
  // two tetrahedra that share an edge: oriented alike, and not a single shell
  Surface pair;
  pair.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  for (const auto& [a, b, c, d] : {std::array{0U, 1U, 2U, 3U}, {0, 1, 4, 5}})
    for (const auto& face : {std::array{a, b, c}, {a, c, d}, {a, d, b}, {b, d, c}})
      pair.facets.push_back({{{face[0], face[1], face[2]}}, {}});
  EXPECT_EQ(surface_orientation(pair).opposed_edges, 0U);
  EXPECT_FALSE(surface_orientation(pair).single_shell);
}

}  // namespace
}  // namespace hiac
