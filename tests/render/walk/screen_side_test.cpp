#include "hiac/render/walk/screen_side.hpp"

#include <array>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

namespace hiac {
namespace {

// The sign of (a - p) x (b - p) for whole numbers, by the same rule written out: p moved by (e,
// e^2) and the node with the smaller number by (0, e^3), e being infinitesimal.
int side_of_whole(const std::array<long, 2>& a, NodeId id_a, const std::array<long, 2>& b,
                  NodeId id_b, const std::array<long, 2>& p) {
  // polynomials in e, lowest power first, up to e^6
  using Polynomial = std::array<long, 7>;
  const auto coordinate = [](long node, long pixel, std::size_t power, bool moves_down) {
    Polynomial result{};
    result[0] = node - pixel;
    result[power] -= 1;
    if (moves_down) result[3] += 1;
    return result;
  };
  const auto product = [](const Polynomial& f, const Polynomial& g) {
    Polynomial result{};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4 && i + j < 7; ++j) result[i + j] += f[i] * g[j];
    return result;
  };
  const Polynomial ax = coordinate(a[0], p[0], 1, false),
                   ay = coordinate(a[1], p[1], 2, id_a < id_b);
  const Polynomial bx = coordinate(b[0], p[0], 1, false),
                   by = coordinate(b[1], p[1], 2, id_b < id_a);
  const Polynomial one = product(ax, by), two = product(ay, bx);
  for (std::size_t k = 0; k < 7; ++k)
    if (one[k] != two[k]) return one[k] > two[k] ? 1 : -1;
  return 0;
}

RayNode node_at(double x, double y) { return {x, y, 0, 0}; }

TEST(ScreenSide, IsThatOfMovedPointsOnALattice) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<long> any(-2, 2);
  int undecided = 0;
  for (int n = 0; n < 20000; ++n) {
    const std::array<long, 2> a{any(random), any(random)}, b{any(random), any(random)},
        p{any(random), any(random)};
    const NodeId id_a = n % 2 == 0 ? 3 : 8, id_b = n % 2 == 0 ? 5 : 4;
    const int expected = side_of_whole(a, id_a, b, id_b, p);
    ASSERT_NE(expected, 0);
    undecided += (a[0] - p[0]) * (b[1] - p[1]) == (a[1] - p[1]) * (b[0] - p[0]);
    for (const double scale : {1.0, 0x1p-40}) {
      const RayNode left =
          node_at(scale * static_cast<double>(a[0]), scale * static_cast<double>(a[1]));
      const RayNode right =
          node_at(scale * static_cast<double>(b[0]), scale * static_cast<double>(b[1]));
      const double x = scale * static_cast<double>(p[0]), y = scale * static_cast<double>(p[1]);
      ASSERT_EQ(is_left(left, id_a, right, id_b, x, y), expected > 0)
          << a[0] << ' ' << a[1] << ", " << b[0] << ' ' << b[1] << ", " << p[0] << ' ' << p[1];
      ASSERT_EQ(is_left(right, id_b, left, id_a, x, y), expected < 0);
    }
  }
  EXPECT_GT(undecided, 3000);
}

// One ulp beside the middle of an edge, where products of rounded differences are as good as equal.
TEST(ScreenSide, IsExactOneUlpOff) {
  std::mt19937_64 random(2);
  std::uniform_int_distribution<std::int64_t> any(std::int64_t{1} << 51, std::int64_t{1} << 52);
  const auto real = [](std::int64_t whole) { return static_cast<double>(whole) * 0x1p-46; };
  for (int n = 0; n < 3000; ++n) {
    const std::int64_t ax = any(random), ay = any(random), bx = any(random), by = any(random);
    const std::int64_t x = (ax + bx) / 2 + n % 3 - 1, y = (ay + by) / 2 + n % 5 - 2;
    __extension__ using Wide = __int128;
    const Wide one = static_cast<Wide>(ax - x) * (by - y),
               two = static_cast<Wide>(ay - y) * (bx - x);
    if (one == two) continue;
    ASSERT_EQ(
        is_left(node_at(real(ax), real(ay)), 1, node_at(real(bx), real(by)), 2, real(x), real(y)),
        one > two);
  }
}

// Whatever the places of a tetrahedron's nodes: the ray of a pixel passes none of its faces or two.
TEST(ScreenSide, RaysPassTwoFacesOfATetrahedronOrNone) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> any(0, 3);
  std::uniform_real_distribution<double> small(-1, 1);
  int passed = 0;
  for (int n = 0; n < 40000; ++n) {
    std::array<RayNode, 4> nodes;
    for (RayNode& node : nodes) {
      node = node_at(any(random), any(random));
      if (n % 4 == 1) node.x += 0x1p-51 * any(random);
      if (n % 4 == 2) node.y += small(random);
    }
    const double x = any(random), y = any(random) + (n % 8 == 1 ? 0x1p-52 : 0);
    int faces = 0;
    for (std::size_t lacking = 0; lacking < 4; ++lacking) {
      std::array<NodeId, 3> corner{};
      for (NodeId k = 0, m = 0; k < 4; ++k)
        if (k != lacking) corner[m++] = k;
      std::array<bool, 3> left{};
      for (std::size_t k = 0; k < 3; ++k) {
        const NodeId a = corner[k], b = corner[(k + 1) % 3];
        left[k] = is_left(nodes[a], a, nodes[b], b, x, y);
      }
      faces += left[0] == left[1] && left[1] == left[2];
    }
    ASSERT_TRUE(faces == 0 || faces == 2) << faces << " faces, case " << n;
    passed += faces == 2;
  }
  EXPECT_GT(passed, 3000);
}

}  // namespace
}  // namespace hiac
