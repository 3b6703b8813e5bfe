#include "hiac/tetrahedralize/meshing/delaunay.hpp"

#include <random>
#include <set>

#include <gtest/gtest.h>

namespace hiac {
namespace {

using Position = std::array<double, 3>;
__extension__ using Wide = __int128;

// Whole coordinates, so that determinants are exact in 128 bits.
using Whole = std::array<Wide, 4>;  // x, y, z and their squares' sum, relative to a point
Whole relative(const Position& p, const Position& q) {
  Whole w{};
  for (std::size_t c = 0; c < 3; ++c) {
    w[c] = static_cast<Wide>(p[c]) - static_cast<Wide>(q[c]);
    w[3] += w[c] * w[c];
  }
  return w;
}
Wide det3(const Whole& a, const Whole& b, const Whole& c, std::array<std::size_t, 3> k) {
  return a[k[0]] * (b[k[1]] * c[k[2]] - b[k[2]] * c[k[1]]) -
         a[k[1]] * (b[k[0]] * c[k[2]] - b[k[2]] * c[k[0]]) +
         a[k[2]] * (b[k[0]] * c[k[1]] - b[k[1]] * c[k[0]]);
}
Wide volume6(const Position& a, const Position& b, const Position& c, const Position& d) {
  return det3(relative(b, a), relative(c, a), relative(d, a), {0, 1, 2});
}
// Positive when e is inside the sphere through a, b, c, d, which are positively oriented.
Wide in_sphere(const Position& a, const Position& b, const Position& c, const Position& d,
               const Position& e) {
  const Whole A = relative(a, e), B = relative(b, e), C = relative(c, e), D = relative(d, e);
  return -(D[3] * det3(A, B, C, {0, 1, 2}) - C[3] * det3(A, B, D, {0, 1, 2}) +
           B[3] * det3(A, C, D, {0, 1, 2}) - A[3] * det3(B, C, D, {0, 1, 2}));
}

TEST(Delaunay, NoPointIsInsideASphereAndTheCubeIsFilled) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    std::mt19937_64 random(seed);
    std::vector<Position> points;
    for (const double x : {0.0, 16.0})
      for (const double y : {0.0, 16.0})
        for (const double z : {0.0, 16.0}) points.push_back({x, y, z});
    // on a coarse lattice many points lie on common spheres
    for (int i = 0; i < 30; ++i)
      points.push_back({static_cast<double>(random() % 17), static_cast<double>(random() % 17),
                        static_cast<double>(random() % 17)});
    Wide volume = 0;
    for (const auto& [a, b, c, d] : delaunay_tetrahedra(points)) {
      const Wide part = volume6(points[a], points[b], points[c], points[d]);
      EXPECT_TRUE(part > 0);
      volume += part;
      for (const Position& e : points)
        EXPECT_TRUE(in_sphere(points[a], points[b], points[c], points[d], e) <= 0);
    }
    EXPECT_TRUE(volume == Wide{6} * 16 * 16 * 16);
  }
}

TEST(Delaunay, KnowsInsideFromOutside) {
  const Position a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0}, d{0, 0, 4};
  EXPECT_TRUE(in_sphere(a, b, c, d, {2, 2, 2}) > 0);
  EXPECT_TRUE(in_sphere(a, b, c, d, {9, 9, 9}) < 0);
  EXPECT_TRUE(in_sphere(a, b, c, d, {4, 4, 4}) == 0);
}

TEST(Delaunay, PointsOfAPlaneHaveNoneAndRepeatedOnesAreUsedOnce) {
  const std::vector<Position> plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.25, 0}};
  EXPECT_TRUE(delaunay_tetrahedra(plane).empty());
  EXPECT_TRUE(delaunay_tetrahedra({}).empty());
  const std::vector<Position> twice{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  const auto tetrahedra = delaunay_tetrahedra(twice);
  ASSERT_EQ(tetrahedra.size(), 1U);
  EXPECT_EQ(std::set(tetrahedra[0].begin(), tetrahedra[0].end()).size(), 4U);
}

}  // namespace
}  // namespace hiac
