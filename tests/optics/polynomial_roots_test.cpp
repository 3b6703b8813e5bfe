#include "hiac/optics/polynomial_roots.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace hiac {
namespace {

std::vector<RootEnclosure> roots_of(const std::vector<double>& c, double s) {
  std::vector<RootEnclosure> roots;
  append_roots(BernsteinPolynomial(c), s, roots);
  return roots;
}

double width(const std::vector<RootEnclosure>& roots) {
  double sum = 0;
  for (const RootEnclosure& r : roots) sum += r.high - r.low;
  return sum;
}

bool encloses(const std::vector<RootEnclosure>& roots, double t) {
  return std::ranges::any_of(roots,
                             [t](const RootEnclosure& r) { return r.low <= t && t <= r.high; });
}

/// Bernstein coefficients of the product of the linear factors t - r.
std::vector<double> with_roots(const std::vector<double>& rs) {
  std::vector<double> c{1};
  for (const double r : rs) {  // times -r (1 - t) + (1 - r) t
    const auto n = static_cast<double>(c.size());
    std::vector<double> product(c.size() + 1, 0.0);
    for (std::size_t i = 0; i < c.size(); ++i) {
      product[i] += c[i] * -r * (n - static_cast<double>(i)) / n;
      product[i + 1] += c[i] * (1 - r) * static_cast<double>(i + 1) / n;
    }
    c = product;
  }
  return c;
}

TEST(PolynomialRoots, FindsTheRootOfALine) {
  const auto roots = roots_of({2, 6}, 3);
  ASSERT_EQ(roots.size(), 1u);
  EXPECT_TRUE(encloses(roots, 0.25));
  EXPECT_LT(width(roots), 1e-14);
}

TEST(PolynomialRoots, FindsRootsAtTheEnds) {
  EXPECT_TRUE(encloses(roots_of({1, 2}, 1), 0));
  EXPECT_TRUE(encloses(roots_of({1, 2}, 2), 1));
  EXPECT_TRUE(encloses(roots_of({0, 1, 0}, 0), 0));
  EXPECT_TRUE(encloses(roots_of({0, 1, 0}, 0), 1));
}

TEST(PolynomialRoots, FindsNoneWhereThereIsNone) {
  EXPECT_TRUE(roots_of({1, 2, 3}, 0.5).empty());
  EXPECT_TRUE(roots_of({5}, 5).empty());
  EXPECT_TRUE(roots_of({5, 5, 5, 5}, 5).empty());
  EXPECT_TRUE(roots_of({0, 1, 0}, 0.5 + 1e-9).empty());  // its top is 1/2
}

TEST(PolynomialRoots, EnclosesATangency) {
  const auto roots = roots_of({0, 1, 0}, 0.5);  // 2 t (1 - t) touches 1/2 at t = 1/2
  EXPECT_TRUE(encloses(roots, 0.5));
  EXPECT_LT(width(roots), 1e-6);
  for (const RootEnclosure& r : roots) EXPECT_LT(r.deviation, 1e-14);
}

TEST(PolynomialRoots, SeparatesCloseRoots) {
  const auto roots = roots_of(with_roots({0.37, 0.37 + 1e-5, 0.8}), 0);
  ASSERT_EQ(roots.size(), 3u);
  EXPECT_NEAR(roots[0].low, 0.37, 1e-9);
  EXPECT_NEAR(roots[2].low, 0.8, 1e-13);
  EXPECT_LT(width(roots), 1e-8);
}

TEST(PolynomialRoots, EnclosesEveryRandomRootAndDoubtsLittle) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<double> expected(1 + static_cast<std::size_t>(trial) % 6);
    for (double& r : expected) r = uniform(engine);
    std::ranges::sort(expected);
    double separation = 1;
    for (std::size_t i = 1; i < expected.size(); ++i)
      separation = std::min(separation, expected[i] - expected[i - 1]);
    const auto roots = roots_of(with_roots(expected), 0);
    if (separation < 0.05) continue;
    // the coefficients themselves were rounded: that moves the roots a little
    ASSERT_EQ(roots.size(), expected.size());
    for (std::size_t i = 0; i < roots.size(); ++i)
      EXPECT_NEAR(0.5 * (roots[i].low + roots[i].high), expected[i], 1e-9);
    EXPECT_LT(width(roots), 1e-8);
  }
}

/// Roots at the ends of parabolas that turn in the middle, where parts are divided: what the slope
/// is there says nothing of the roots.
TEST(PolynomialRoots, EnclosesRootsFarFromWhereTheSlopeVanishes) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> uniform(-1e-13, 1e-13);
  for (int trial = 0; trial < 1000; ++trial) {
    const std::vector<double> c{uniform(engine), -1, uniform(engine)};
    for (const RootEnclosure& root : roots_of(c, 0))
      EXPECT_LT(root.high - root.low, 1e-14) << c[0] << ' ' << c[2];
  }
}

/// Outside the enclosures the sign of f - s, in long double, does not change.
TEST(PolynomialRoots, SignsAreCertainOutsideTheEnclosures) {
  std::mt19937_64 engine(6);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<double> c(2 + static_cast<std::size_t>(trial) % 8);
    for (double& v : c) v = uniform(engine);
    const double s = 0.3 * uniform(engine);
    const auto roots = roots_of(c, s);
    const auto value = [&](double t) {
      std::vector<long double> d(c.begin(), c.end());
      for (std::size_t n = d.size() - 1; n > 0; --n)
        for (std::size_t i = 0; i < n; ++i)
          d[i] = (1 - static_cast<long double>(t)) * d[i] + static_cast<long double>(t) * d[i + 1];
      return d[0] - static_cast<long double>(s);
    };
    double from = 0;
    for (std::size_t r = 0; r <= roots.size(); ++r) {
      const double to = r < roots.size() ? roots[r].low : 1;
      if (to > from) {
        const bool positive = value(0.5 * (from + to)) > 0;
        for (int i = 1; i < 100; ++i)
          EXPECT_EQ(value(from + (to - from) * 0.01 * i) > 0, positive) << trial;
      }
      if (r < roots.size()) from = roots[r].high;
    }
  }
}

}  // namespace
}  // namespace hiac
