#include "hiac/check/lifted_orientation.hpp"

#include <cmath>
#include <random>

#include <gmpxx.h>
#include <gtest/gtest.h>

namespace hiac {
namespace {

using Place = std::array<double, 3>;
using Rows = std::array<std::array<mpq_class, 4>, 4>;

int sign_of(const Rows& r) {
  mpq_class sum = 0;
  std::array<std::size_t, 4> p{0, 1, 2, 3};
  do {
    int swaps = 0;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) swaps += p[j] > p[i] ? 1 : 0;
    const mpq_class term = r[0][p[0]] * r[1][p[1]] * r[2][p[2]] * r[3][p[3]];
    sum += swaps % 2 == 0 ? term : mpq_class(-term);
  } while (std::ranges::next_permutation(p).found);
  return sgn(sum);
}

Rows rows_of(const std::array<Place, 5>& at) {
  Rows rows;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t c = 0; c < 3; ++c) rows[i][c] = mpq_class(at[i + 1][c]) - mpq_class(at[0][c]);
  return rows;
}

void expect_exact(const std::array<Place, 5>& at, const std::array<double, 5>& heights) {
  Rows rows = rows_of(at);
  for (auto& r : rows) r[3] = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
  EXPECT_EQ(outside_sphere(at[0], at[1], at[2], at[3], at[4]), sign_of(rows));
  for (std::size_t i = 0; i < 4; ++i)
    rows[i][3] = mpq_class(heights[i + 1]) - mpq_class(heights[0]);
  EXPECT_EQ(lifted_orientation({at[0], at[1], at[2], at[3], at[4]}, heights), sign_of(rows));
}

// Places on a lattice, of which many are on one sphere; the same pushed by an ulp, far from the
// origin, and very large and small.
TEST(LiftedOrientation, AsInRationalNumbers) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> whole(-2, 2), ulps(-1, 1);
  for (int i = 0; i < 4000; ++i) {
    std::array<Place, 5> at;
    std::array<double, 5> heights;
    const double scale = std::ldexp(1.0, i % 5 == 4 ? -200 : i % 5 == 3 ? 150 : 0);
    const double off = i % 5 == 2 ? 1e6 : 0;
    for (std::size_t k = 0; k < 5; ++k) {
      heights[k] = scale * whole(random);
      for (double& x : at[k]) {
        x = scale * (whole(random) + off);
        const int by = i % 5 == 1 ? ulps(random) : 0;
        if (by != 0) x = std::nextafter(x, by * 1e300);
      }
    }
    expect_exact(at, heights);
  }
}

TEST(LiftedOrientation, HasTheSignsThatItsNamesSay) {
  const Place o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  EXPECT_EQ(outside_sphere(o, x, y, z, Place{2, 2, 2}), 1);
  EXPECT_EQ(outside_sphere(o, x, y, z, Place{1, 1, 1}), 0);
  EXPECT_EQ(outside_sphere(o, x, y, z, Place{0.5, 0.5, 0.5}), -1);
  EXPECT_EQ(lifted_orientation({o, x, y, z, Place{1, 1, 1}}, {0, 1, 1, 1, 3.5}), 1);
  EXPECT_EQ(lifted_orientation({o, x, y, z, Place{1, 1, 1}}, {0, 1, 1, 1, 3}), 0);
}

}  // namespace
}  // namespace hiac
