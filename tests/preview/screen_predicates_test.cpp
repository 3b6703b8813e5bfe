#include "hiac/preview/regions/screen_predicates.hpp"

#include <cmath>
#include <random>

#include <gmpxx.h>
#include <gtest/gtest.h>

namespace hiac::preview {
namespace {

mpq_class cross(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c,
                const ScreenPoint& d) {
  const mpq_class ax(a.x), ay(a.y), bx(b.x), by(b.y), cx(c.x), cy(c.y), dx(d.x), dy(d.y);
  return (bx - ax) * (dy - cy) - (by - ay) * (dx - cx);
}

// Points of a lattice, of the plane, and close to one another or to a line: doubts abound.
ScreenPoint random_point(std::mt19937_64& random, int kind) {
  const auto real = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
  if (kind == 0) return {static_cast<double>(random() % 5), static_cast<double>(random() % 5)};
  if (kind == 1) return {1000 * real(), 1000 * real()};
  if (kind == 2) {
    const double t = real();
    return {0.1 + 0.3 * t, 0.7 - 1.7 * t};
  }
  return {0.5 + 0x1p-52 * static_cast<double>(random() % 8),
          12 + 0x1p-49 * static_cast<double>(random() % 8)};
}

TEST(ScreenPredicates, AreThoseOfRationalNumbers) {
  std::mt19937_64 random(1);
  int zeros = 0, crossings = 0, zero_crossings = 0;
  for (int i = 0; i < 40000; ++i) {
    ScreenPoint p[6];
    const int kind = static_cast<int>(random() % 5);
    for (ScreenPoint& q : p)
      q = random_point(random, kind == 4 ? static_cast<int>(random() % 4) : kind);
    const mpq_class area = cross(p[0], p[1], p[0], p[2]);
    ASSERT_EQ(side(p[0], p[1], p[2]), sgn(area));
    EXPECT_NEAR(twice_area(p[0], p[1], p[2]), area.get_d(), 1e-9 * std::abs(area.get_d()));
    ASSERT_EQ(turn(p[0], p[1], p[2], p[3]), sgn(cross(p[0], p[1], p[2], p[3])));
    zeros += area == 0 ? 1 : 0;
    const mpq_class slope = cross(p[4], p[5], p[2], p[3]);
    if (slope == 0) continue;
    // the crossing itself
    const mpq_class t = -cross(p[4], p[5], p[4], p[2]) / slope;
    const mpq_class x = mpq_class(p[2].x) + t * (mpq_class(p[3].x) - mpq_class(p[2].x));
    const mpq_class y = mpq_class(p[2].y) + t * (mpq_class(p[3].y) - mpq_class(p[2].y));
    const mpq_class ax(p[0].x), ay(p[0].y), bx(p[1].x), by(p[1].y);
    const mpq_class of_crossing = (bx - ax) * (y - ay) - (by - ay) * (x - ax);
    ASSERT_EQ(side_of_crossing(p[0], p[1], p[2], p[3], p[4], p[5]), sgn(of_crossing));
    ++crossings;
    zero_crossings += of_crossing == 0 ? 1 : 0;
  }
  // the cases that the exact paths are for
  EXPECT_GT(zeros, 1000);
  EXPECT_GT(crossings, 20000);
  EXPECT_GT(zero_crossings, 1000);
}

}  // namespace
}  // namespace hiac::preview
