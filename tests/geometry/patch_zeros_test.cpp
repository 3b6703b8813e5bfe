#include "hiac/geometry/patch_zeros.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/seconds.hpp"

namespace hiac {
namespace {

constexpr std::array<PatchShape, 5> kShapes{
    {{1, false, false}, {2, false, false}, {3, false, false}, {2, true, false}, {3, true, true}}};

struct Map {
  PatchShape shape;
  PatchNet<double> a, b, depth{};

  [[nodiscard]] PatchZeroQuestion question(int winding, bool one_way) const {
    return {.shape = shape, .a = a, .b = b, .depth = depth, .winding = winding, .one_way = one_way};
  }

  [[nodiscard]] std::array<double, 2> at(double u, double v) const {
    const BernsteinValues bu(shape.degree, u), bv(shape.degree, v);
    return {evaluate_patch(shape.degree, a, bu, bv).value,
            evaluate_patch(shape.degree, b, bu, bv).value};
  }
};

// The identity less a random zero, with random bumps.
Map random_map(const PatchShape& shape, double bumps, std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  Map map{shape, {}, {}, {}};
  const std::size_t n = shape.degree, side = n + 1;
  const double p = 0.5 + 0.4 * number(random), q = 0.5 + 0.4 * number(random);
  for (std::size_t j = 0; j < side; ++j)
    for (std::size_t i = 0; i < side; ++i) {
      const auto u = static_cast<double>(i) / static_cast<double>(n),
                 v = static_cast<double>(j) / static_cast<double>(n);
      map.a[i + side * j] = u - p + bumps * number(random);
      map.b[i + side * j] = v - q + bumps * number(random);
    }
  return map;
}

// How often the image of the border winds around 0, by following it in small steps.
int winding_of(const Map& map) {
  constexpr int kSteps = 4000;
  const std::size_t corners = map.shape.corner_count();
  const std::array<std::array<double, 2>, 4> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const std::array<std::array<double, 2>, 4> triangle{{{0, 0}, {1, 0}, {0, 1}, {0, 0}}};
  const auto& at = map.shape.triangle ? triangle : square;
  double angle = 0;
  std::array<double, 2> before = map.at(0, 0);
  for (std::size_t k = 0; k < corners; ++k)
    for (int i = 1; i <= kSteps; ++i) {
      const auto &from = at[k], &to = at[(k + 1) % corners];
      const double s = static_cast<double>(i) / kSteps;
      const auto here = map.at(from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1]));
      angle += std::atan2(before[0] * here[1] - before[1] * here[0],
                          before[0] * here[0] + before[1] * here[1]);
      before = here;
    }
  return static_cast<int>(std::lround(angle / (2 * 3.141592653589793)));
}

// Zeros by brute force: a fine grid of squares, Newton's iteration from each where both change
// sign or nearly so.
std::vector<std::array<double, 2>> brute_force(const Map& map) {
  constexpr int kGrid = 96;
  std::vector<std::array<double, 2>> zeros;
  for (int j = 0; j < kGrid; ++j)
    for (int i = 0; i < kGrid; ++i) {
      double u = (i + 0.5) / kGrid, v = (j + 0.5) / kGrid;
      for (int step = 0; step < 8; ++step) {
        const BernsteinValues bu(map.shape.degree, u), bv(map.shape.degree, v);
        const PatchValue a = evaluate_patch(map.shape.degree, map.a, bu, bv),
                         b = evaluate_patch(map.shape.degree, map.b, bu, bv);
        const double d = a.by_u * b.by_v - a.by_v * b.by_u;
        u -= (a.value * b.by_v - a.by_v * b.value) / d;
        v -= (a.by_u * b.value - a.value * b.by_u) / d;
        if (!(std::abs(u) < 3 && std::abs(v) < 3)) break;
      }
      if (!(u >= 0 && v >= 0 && (map.shape.triangle ? u + v <= 1 : std::max(u, v) <= 1))) continue;
      const auto value = map.at(u, v);
      if (std::hypot(value[0], value[1]) > 1e-12) continue;
      bool known = false;
      for (const auto& zero : zeros) known = known || std::hypot(zero[0] - u, zero[1] - v) < 1e-6;
      if (!known) zeros.push_back({u, v});
    }
  return zeros;
}

TEST(PatchZeros, RandomMapsAgreeWithBruteForce) {
  std::mt19937 random(7);
  std::array<int, 8> met{};
  for (const PatchShape& shape : kShapes)
    for (const double bumps : {0.1, 0.6, 1.5})
      for (int i = 0; i < 12; ++i) {
        const Map map = random_map(shape, bumps, random);
        const auto expected = brute_force(map);
        const PatchZeros found = patch_zeros(map.question(winding_of(map), false));
        ASSERT_EQ(found.size(), expected.size()) << int{shape.degree} << " bumps " << bumps;
        for (const PatchZero& zero : found) {
          double nearest = 1;
          for (const auto& e : expected)
            nearest = std::min(nearest, std::hypot(e[0] - zero.u, e[1] - zero.v));
          EXPECT_LE(nearest, 1e-11);
        }
        ++met[expected.size()];
      }
  EXPECT_GT(met[0], 5);
  EXPECT_GT(met[1], 20);
  EXPECT_GT(met[2], 3);
}

TEST(PatchZeros, MapsThatTurnOneWayNeedNoSearch) {
  std::mt19937 random(8);
  for (const PatchShape& shape : kShapes)
    for (int i = 0; i < 20; ++i) {
      const Map map = random_map(shape, 0.05, random);
      const int winding = winding_of(map);
      const PatchZeros found = patch_zeros(map.question(winding, true));
      ASSERT_EQ(found.size(), static_cast<std::size_t>(std::abs(winding)));
      if (winding == 0) continue;
      const auto value = map.at(found[0].u, found[0].v);
      EXPECT_LE(std::hypot(value[0], value[1]), 1e-14);
    }
}

// What the border says counts, whatever the map is: nothing where 0 lies outside by more than
// rounding, one zero on the border, not-a-number.
TEST(PatchZeros, TheWindingNumberDecides) {
  for (const PatchShape& shape : kShapes) {
    std::mt19937 random(9);
    Map map = random_map(shape, 0.05, random);
    for (const double shift : {0.0, 1e-15, -1e-15, 5.0}) {
      Map moved = map;
      const double edge = map.a[0] - shift;
      for (std::size_t k = 0; k < shape.control_count(); ++k) moved.a[k] -= edge;
      for (const int winding : {0, 1, -1, 2}) {
        const PatchZeros found = patch_zeros(moved.question(winding, false));
        int sum = 0;
        for (const PatchZero& zero : found) {
          sum += zero.sign;
          EXPECT_GE(std::min(zero.u, zero.v), 0);
          EXPECT_LE(shape.triangle ? zero.u + zero.v : std::max(zero.u, zero.v), 1 + 1e-15);
        }
        EXPECT_EQ(sum, winding);
      }
    }
    map.a[0] = std::nan("");
    EXPECT_EQ(patch_zeros(map.question(1, false)).size(), 1U);
    EXPECT_EQ(patch_zeros(map.question(0, false)).size(), 0U);
  }
}

// Rays that run along a face: the search ends, though every part along the curve holds zeros.
TEST(PatchZeros, CurvesOfZerosAreNotFollowedToTheEnd) {
  for (const PatchShape& shape : kShapes) {
    Map map{shape, {}, {}, {}};
    const std::size_t n = shape.degree, side = n + 1;
    for (std::size_t j = 0; j < side; ++j)
      for (std::size_t i = 0; i < side; ++i) {
        const auto u = static_cast<double>(i) / static_cast<double>(n),
                   v = static_cast<double>(j) / static_cast<double>(n);
        map.a[i + side * j] = u - 0.4;
        map.b[i + side * j] = (u - 0.4) * (v - 0.3);
      }
    const double start = seconds_now();
    const PatchZeros zeros = patch_zeros(map.question(0, false));
    EXPECT_LT(seconds_now() - start, 5);
    for (const PatchZero& zero : zeros) EXPECT_NEAR(zero.u, 0.4, 1e-3);
  }
}

// A ray in a patch seen edge-on meets it where it comes in, not at the corner that is nearest to
// it.
TEST(PatchZeros, SeenEdgeOnThePatchIsMetWhereTheRayComesIn) {
  for (const PatchShape& shape : kShapes)
    for (const double bend : {0.0, 1e-15, 1e-13}) {
      std::mt19937 random(11);
      std::uniform_real_distribution<double> number(-1, 1);
      Map map{shape, {}, {}, {}};
      const std::size_t n = shape.degree, side = n + 1;
      for (std::size_t j = 0; j < side; ++j)
        for (std::size_t i = 0; i < side; ++i) {
          const auto u = static_cast<double>(i) / static_cast<double>(n),
                     v = static_cast<double>(j) / static_cast<double>(n);
          map.a[i + side * j] = u - v + 0.1;
          map.b[i + side * j] = 2 * (u - v + 0.1) + bend * number(random);
          map.depth[i + side * j] = 2 + u + 3 * v;
        }
      PatchZeroQuestion question = map.question(1, false);
      question.rounding = 0x1p-36;
      const PatchZeros found = patch_zeros(question);
      ASSERT_EQ(found.size(), 1U);
      EXPECT_EQ(found[0].u, 0) << int{shape.degree} << ' ' << bend;
      EXPECT_NEAR(found[0].v, 0.1, 1e-12);
    }
}

// A ray along an edge meets all faces around it where the edge is nearest.
TEST(PatchZeros, OnAnEdgeTheLeastDeepCornerIsTaken) {
  for (const PatchShape& shape : kShapes) {
    std::mt19937 random(10);
    Map map = random_map(shape, 0.05, random);
    for (std::size_t k = 0; k < shape.control_count(); k += shape.degree + 1U) {
      map.a[k] = map.b[k] = 0;  // u = 0
      map.depth[k] = 3 - static_cast<double>(k);
    }
    const PatchZeros found = patch_zeros(map.question(-1, false));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].u, 0);
    EXPECT_EQ(found[0].v, 1);
    EXPECT_EQ(patch_zeros(map.question(0, false)).size(), 0U);
  }
}

}  // namespace
}  // namespace hiac
