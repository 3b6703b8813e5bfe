// Chebyshev series of polynomials over powers of 1 + h z against sums over very many points.

#include <hwy/highway.h>
// must come after highway.h
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/render/chebyshev_quotient-inl.hpp"

namespace hiac {
namespace {

struct Quotient {
  std::vector<double> c;  // of powers
  double h;
  std::size_t pole_order;

  [[nodiscard]] std::size_t degree() const { return c.size() - 1; }
  [[nodiscard]] long double at(long double z) const {
    long double sum = 0;
    for (std::size_t k = c.size(); k-- > 0;) sum = sum * z + c[k];
    for (std::size_t k = 0; k < pole_order; ++k) sum /= 1 + h * z;
    return sum;
  }
  // By so many points that no other coefficient that they count with it is above rounding.
  [[nodiscard]] long double coefficient(std::size_t k) const {
    constexpr std::size_t kPoints = 400;
    long double sum = 0;
    for (std::size_t j = 0; j < kPoints; ++j) {
      const long double angle = std::numbers::pi_v<long double> * (j + 0.5L) / kPoints;
      sum += at(std::cos(angle)) * std::cos(static_cast<long double>(k) * angle);
    }
    return (k == 0 ? 1 : 2) * sum / kPoints;
  }
};

// Those of shape functions of pyramids and wedges (quotient_along_lines).
constexpr std::array<std::array<std::size_t, 2>, 5> kDegreesAndPoles{
    {{2, 1}, {3, 1}, {5, 2}, {7, 3}, {4, 2}}};

class Quotients {
 public:
  Quotient next(double steepest) {
    const auto [n, p] = kDegreesAndPoles[random_() % kDegreesAndPoles.size()];
    std::uniform_real_distribution<double> number(-1, 1);
    Quotient q{std::vector<double>(n + 1), steepest * number(random_), p};
    for (double& c : q.c) c = number(random_);
    return q;
  }

 private:
  std::mt19937 random_{7};
};

struct Expanded {
  std::size_t degree;
  bool resolved;
  std::array<double, kMostChebyshevDegree + 1> c;
};
Expanded expand(const Quotient& q, double negligible, std::size_t end) {
  namespace simd = HWY_NAMESPACE;
  const hwy::HWY_NAMESPACE::CappedTag<double, 1> d;
  using V = hwy::HWY_NAMESPACE::Vec<decltype(d)>;
  const std::size_t n = q.degree();
  std::array<double, kMostChebyshevDegree + 1> values{}, agreeing{};
  for (std::size_t j = 0; j <= n; ++j)
    values[j] = static_cast<double>(q.at(2 * chebyshev_points(n).place(j) - 1));
  chebyshev_points(n).coefficients(values.data(), 1, agreeing.data());
  V c[kMostChebyshevDegree + 1];
  for (std::size_t k = 0; k <= n; ++k) c[k] = Set(d, agreeing[k]);
  auto active = Eq(Zero(d), Zero(d));
  const double r = q.h / (1 + std::sqrt((1 - q.h) * (1 + q.h)));
  const simd::ChebyshevQuotient<decltype(d)> quotient(d, Set(d, r));
  Expanded expanded{};
  expanded.degree = quotient.expand(q.pole_order, n, end, Set(d, negligible), active, c);
  expanded.resolved = AllTrue(d, active);
  for (std::size_t k = 0; k <= expanded.degree; ++k) expanded.c[k] = GetLane(c[k]);
  return expanded;
}

TEST(ChebyshevQuotients, HaveTheCoefficientsOfTheFunction) {
  Quotients quotients;
  const auto compare = [](const Quotient& q, const Expanded& found, double most) {
    ASSERT_GT(found.degree, 0);
    ASSERT_LE(found.degree, kMostChebyshevDegree);
    EXPECT_TRUE(found.resolved);
    for (std::size_t k = 0; k <= found.degree; ++k)
      EXPECT_NEAR(found.c[k], static_cast<double>(q.coefficient(k)), most) << k << " of " << q.h;
  };
  for (int trial = 0; trial < 200; ++trial) {
    const Quotient steep = quotients.next(0.25);
    compare(steep, expand(steep, 1e-9, 0), 1e-9);
    // where nothing is left out they are exact
    const Quotient flat = quotients.next(trial % 2 == 0 ? 0.1 : 1e-9);
    compare(flat, expand(flat, 1e-9, kMostChebyshevDegree), 1e-14);
  }
}

TEST(ChebyshevQuotients, EndWhereTheRestIsNegligible) {
  Quotients quotients;
  std::size_t ended = 0, refused = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Quotient q = quotients.next(0.8);
    constexpr double kNegligible = 1e-7;
    const Expanded found = expand(q, kNegligible, 0);
    const auto two = [&](std::size_t k) {
      return std::abs(q.coefficient(k - 1)) + std::abs(q.coefficient(k));
    };
    if (found.degree == 0) {
      ++refused;
      EXPECT_FALSE(found.resolved);
      // the last degrees that there might have been
      EXPECT_GT(two(kMostChebyshevDegree) + two(kMostChebyshevDegree - 1), 0.5 * kNegligible);
      continue;
    }
    ++ended;
    EXPECT_LE(two(found.degree), 1.01 * kNegligible);
    EXPECT_LE(found.degree, kMostChebyshevDegree);
  }
  EXPECT_GT(ended, 300);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace hiac
