#include "hiac/geometry/predicates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "hiac/geometry/exact_determinant.hpp"
#include "tests/geometry/rational_orientation.hpp"

namespace hiac::test {
namespace {

using Point = std::array<double, 3>;
using Points = std::array<Point, 4>;  // for orientation_towards the last one is the vector

// Both predicates and their slow paths say what rational arithmetic says.
void expect_right(const Points& p) {
  const int sign = rational_orientation(p[0], p[1], p[2], p[3]);
  const int towards = rational_orientation_towards(p[0], p[1], p[2], p[3]);
  ASSERT_EQ(orientation(p[0], p[1], p[2], p[3]), sign);
  ASSERT_EQ(exact_orientation(p[0], p[1], p[2], p[3]), sign);
  ASSERT_EQ(orientation_towards(p[0], p[1], p[2], p[3]), towards);
  ASSERT_EQ(exact_orientation_towards(p[0], p[1], p[2], p[3]), towards);
}

bool is_even(const std::array<std::size_t, 4>& permutation) {
  int inversions = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) inversions += permutation[i] > permutation[j] ? 1 : 0;
  return inversions % 2 == 0;
}

void expect_antisymmetric(const Points& p) {
  const int sign = orientation(p[0], p[1], p[2], p[3]);
  std::array<std::size_t, 4> at{0, 1, 2, 3};
  do {
    ASSERT_EQ(orientation(p[at[0]], p[at[1]], p[at[2]], p[at[3]]), is_even(at) ? sign : -sign);
  } while (std::next_permutation(at.begin(), at.end()));
  const int towards = orientation_towards(p[0], p[1], p[2], p[3]);
  const Point opposite{-p[3][0], -p[3][1], -p[3][2]};
  ASSERT_EQ(orientation_towards(p[1], p[2], p[0], p[3]), towards);
  ASSERT_EQ(orientation_towards(p[0], p[2], p[1], p[3]), -towards);
  ASSERT_EQ(orientation_towards(p[0], p[1], p[2], opposite), -towards);
}

template <typename Coordinate>
Points points_of(Coordinate coordinate) {
  Points p;
  for (Point& point : p)
    for (double& x : point) x = coordinate();
  return p;
}

double moved_by_ulps(double x, int ulps) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (; ulps > 0; --ulps) x = std::nextafter(x, kInfinity);
  for (; ulps < 0; ++ulps) x = std::nextafter(x, -kInfinity);
  return x;
}

TEST(Predicates, SeenFromAboveATriangleRunsCounterClockwise) {
  const Point o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, below{0, 0, -1}, beside{3, 4, 0};
  EXPECT_EQ(orientation(o, x, y, z), 1);
  EXPECT_EQ(orientation(o, x, y, below), -1);
  EXPECT_EQ(orientation(o, x, y, beside), 0);
  EXPECT_EQ(orientation_towards(o, x, y, z), 1);
  EXPECT_EQ(orientation_towards(o, x, y, below), -1);
  EXPECT_EQ(orientation_towards(o, x, y, beside), 0);
}

TEST(Predicates, RandomPoints) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 10000; ++i) {
    const Points p = points_of([&] { return unit(random); });
    ASSERT_NO_FATAL_FAILURE(expect_right(p));
    ASSERT_NO_FATAL_FAILURE(expect_antisymmetric(p));
  }
}

// Four points of a plane, each coordinate then moved by up to two ulps: the sign is left to the
// last bits, and often is zero.
TEST(Predicates, PointsOfAPlaneMovedByUlps) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::uniform_int_distribution<int> ulps(-2, 2);
  int zeros = 0;
  for (const double offset : {0.0, 1.0, 1e6, -1e12}) {
    for (int i = 0; i < 10000; ++i) {
      Points p = points_of([&] { return offset + unit(random); });
      const double s = unit(random), t = unit(random);
      for (std::size_t c = 0; c < 3; ++c)
        p[3][c] = p[0][c] + s * (p[1][c] - p[0][c]) + t * (p[2][c] - p[0][c]);
      for (Point& point : p)
        for (double& x : point) x = moved_by_ulps(x, ulps(random));
      ASSERT_NO_FATAL_FAILURE(expect_right(p));
      ASSERT_NO_FATAL_FAILURE(expect_antisymmetric(p));
      zeros += orientation(p[0], p[1], p[2], p[3]) == 0 ? 1 : 0;
    }
  }
  EXPECT_LT(zeros, 40000);
}

// Small whole numbers, far from the origin or not, and times a power of two: nothing is rounded,
// so points of a plane are exactly that.
TEST(Predicates, ExactlyDegenerate) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> small(-3, 3), power(-1000, 900);
  for (int i = 0; i < 10000; ++i) {
    const double unit = std::ldexp(1.0, i % 2 == 0 ? 0 : power(random));
    const double offset = i % 4 < 2 ? 0 : 0x1p40;
    const auto number = [&] { return static_cast<double>(small(random)); };
    Points p = points_of([&] { return (offset + number()) * unit; });
    ASSERT_NO_FATAL_FAILURE(expect_right(p));
    const double s = number(), t = number();
    for (std::size_t c = 0; c < 3; ++c)
      p[3][c] = p[0][c] + s * (p[1][c] - p[0][c]) + t * (p[2][c] - p[0][c]);
    ASSERT_EQ(orientation(p[0], p[1], p[2], p[3]), 0);
    ASSERT_NO_FATAL_FAILURE(expect_antisymmetric(p));
    for (std::size_t c = 0; c < 3; ++c) p[3][c] = s * (p[1][c] - p[0][c]);
    ASSERT_EQ(orientation_towards(p[0], p[1], p[2], p[3]), 0);
  }
}

TEST(Predicates, RepeatedPointsAreDegenerate) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    Points p = points_of([&] { return unit(random); });
    p[static_cast<std::size_t>(i) % 3 + 1] = p[0];
    ASSERT_EQ(orientation(p[0], p[1], p[2], p[3]), 0);
  }
}

// Sums, differences and products overflow: the filter has to leave these to the exact path.
TEST(Predicates, HugeCoordinates) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const double size : {1e100, 1e102, 1e150, 1e300, std::numeric_limits<double>::max()})
    for (int i = 0; i < 2000; ++i) {
      const Points p = points_of([&] { return size * unit(random); });
      ASSERT_NO_FATAL_FAILURE(expect_right(p));
      ASSERT_NO_FATAL_FAILURE(expect_antisymmetric(p));
    }
}

// Products underflow, down to points that are a few denormal numbers apart.
TEST(Predicates, TinyCoordinates) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const double size : {1e-90, 1e-100, 1e-102, 1e-108, 1e-150, 1e-300, 1e-308, 2e-323})
    for (int i = 0; i < 2000; ++i) {
      const Points p = points_of([&] { return size * unit(random); });
      ASSERT_NO_FATAL_FAILURE(expect_right(p));
      ASSERT_NO_FATAL_FAILURE(expect_antisymmetric(p));
    }
}

// Coordinates of any size beside one another, zeros and denormal numbers included.
TEST(Predicates, MixedSizes) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::uniform_int_distribution<int> power(-1074, 1023), few(0, 5);
  for (int i = 0; i < 10000; ++i) {
    const Points p =
        points_of([&] { return few(random) == 0 ? 0.0 : std::ldexp(unit(random), power(random)); });
    ASSERT_NO_FATAL_FAILURE(expect_right(p));
    ASSERT_NO_FATAL_FAILURE(expect_antisymmetric(p));
  }
}

// A large vector against two small ones: products of the small ones lose bits to underflow, which
// the large one makes count.
TEST(Predicates, UnderflowMadeLarge) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 10000; ++i) {
    Points p{};
    for (std::size_t c = 0; c < 3; ++c) {
      p[1][c] = 1e300 * unit(random);
      p[2][c] = 3e-162 * unit(random);
      p[3][c] = 3e-162 * unit(random);
    }
    ASSERT_NO_FATAL_FAILURE(expect_right(p));
    ASSERT_NO_FATAL_FAILURE(expect_right({p[0], p[2], p[3], p[1]}));
  }
}

}  // namespace
}  // namespace hiac::test
