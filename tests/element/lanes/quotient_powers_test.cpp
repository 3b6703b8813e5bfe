// Polynomials close to polynomials over powers of 1 + h z against these in extended precision.

#include <hwy/highway.h>
// must come after highway.h
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/element/lanes/quotient_powers-inl.hpp"

namespace hiac {
namespace {

using Real = long double;

Real value_of(const std::vector<double>& powers, Real z) {
  Real sum = 0;
  for (std::size_t k = powers.size(); k-- > 0;) sum = sum * z + powers[k];
  return sum;
}

struct Quotient {
  std::vector<double> numerator;  // of powers
  double h;
  std::size_t pole_order;

  [[nodiscard]] Real at(Real z) const {
    Real value = value_of(numerator, z);
    for (std::size_t k = 0; k < pole_order; ++k) value /= 1 + h * z;
    return value;
  }
};

// Those of shape functions of pyramids and wedges (quotient_along_lines).
constexpr std::array<std::array<std::size_t, 2>, 4> kDegreesAndPoles{
    {{2, 1}, {3, 1}, {5, 2}, {7, 3}}};

class Quotients {
 public:
  Quotient next(double steepest) {
    const auto [n, p] = kDegreesAndPoles[random_() % kDegreesAndPoles.size()];
    std::uniform_real_distribution<double> number(-1, 1);
    Quotient q{std::vector<double>(n + 1), steepest * number(random_), p};
    for (double& c : q.numerator) c = number(random_);
    return q;
  }

 private:
  std::mt19937 random_{7};
};

struct Expanded {
  bool resolved;
  std::vector<double> powers;
};

template <std::size_t p, std::size_t n>
Expanded expand_as(const Quotient& q, double negligible) {
  namespace simd = HWY_NAMESPACE;
  const hwy::HWY_NAMESPACE::CappedTag<double, 1> d;
  using V = hwy::HWY_NAMESPACE::Vec<decltype(d)>;
  const ChebyshevPoints& points = chebyshev_points(n);
  V values[n + 1];
  for (std::size_t j = 0; j <= n; ++j)
    values[j] = Set(d, static_cast<double>(q.at(2 * points.place(j) - 1)));
  auto active = Eq(Zero(d), Zero(d));
  // widths of any size
  const simd::Taper<decltype(d)> taper(d, {Set(d, 3 * (1 - q.h)), Set(d, 3 * (1 + q.h))}, active);
  const simd::QuotientPowers<p, n, decltype(d)> quotient(d, points, taper);
  simd::LanePolynomial<V> found;
  const bool resolved = quotient.expand(values, Set(d, negligible), active, found);
  EXPECT_EQ(resolved, AllTrue(d, active));
  Expanded expanded{resolved, {}};
  for (std::size_t k = 0; resolved && k <= found.degree; ++k)
    expanded.powers.push_back(GetLane(found.c[k]));
  return expanded;
}

Expanded expand(const Quotient& q, double negligible) {
  switch (q.numerator.size() - 1) {
    case 2:
      return expand_as<1, 2>(q, negligible);
    case 3:
      return expand_as<1, 3>(q, negligible);
    case 5:
      return expand_as<2, 5>(q, negligible);
    default:
      return expand_as<3, 7>(q, negligible);
  }
}

// The largest difference on [-1, 1].
Real distance(const Quotient& q, const std::vector<double>& powers) {
  Real most = 0;
  for (int i = -200; i <= 200; ++i) {
    const Real z = i / 200.0L;
    most = std::max(most, std::abs(value_of(powers, z) - q.at(z)));
  }
  return most;
}

TEST(Taper, IsThatOfWidths) {
  namespace simd = HWY_NAMESPACE;
  const hwy::HWY_NAMESPACE::CappedTag<double, 1> d;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(0, 1);
  const auto yes = Eq(Zero(d), Zero(d)), no = Lt(Set(d, 1.0), Zero(d));
  for (int trial = 0; trial < 1000; ++trial) {
    const double a = number(random), b = number(random) * (trial % 2 == 0 ? 1 : 1e-12);
    const simd::Taper<decltype(d)> taper(d, {Set(d, a), Set(d, b)}, yes);
    const Real root_a = std::sqrt(Real(a)), root_b = std::sqrt(Real(b));
    const Real r = (root_b - root_a) / (root_b + root_a), h = 2 * r / (1 + r * r);
    const auto near = [](double value, Real expected) {
      EXPECT_NEAR(value, static_cast<double>(expected), 4e-15 * std::abs(value));
    };
    near(GetLane(taper.h), h);
    near(GetLane(taper.r), r);
    near(GetLane(taper.inverse_gap), (Real(a) + b) / (2 * std::min(a, b)));
    near(GetLane(taper.g), (Real(a) + b) / (2 * std::sqrt(Real(a) * b)));
    const simd::Taper<decltype(d)> none(d, {Set(d, a), Set(d, b)}, no);
    EXPECT_EQ(GetLane(none.r), 0);
    EXPECT_EQ(GetLane(none.g), 1);
  }
  const simd::Taper<decltype(d)> tip(d, {Zero(d), Set(d, 1.0)}, yes);
  EXPECT_NEAR(GetLane(tip.r), 1, 1e-15);
  EXPECT_GT(GetLane(tip.inverse_gap), 1e50);
  EXPECT_TRUE(std::isfinite(GetLane(tip.g)));
}

TEST(QuotientPowers, AreOffByNoMoreThanIsNegligible) {
  Quotients quotients;
  for (int trial = 0; trial < 1000; ++trial)
    for (const double negligible : {1e-3, 1e-7, 1e-12}) {
      const Quotient q = quotients.next(trial % 3 == 0 ? 0.05 : trial % 3 == 1 ? 0.25 : 1e-9);
      const Expanded found = expand(q, negligible);
      ASSERT_TRUE(found.resolved);
      // powers of r^2m, and rounding: of coefficients in powers, which are larger than values
      EXPECT_LE(distance(q, found.powers), 1.05L * negligible + 2e-13L)
          << q.h << " of order " << q.pole_order << ", " << negligible;
    }
}

TEST(QuotientPowers, HaveTheLeastDegreeOrAlmost) {
  Quotients quotients;
  std::size_t least = 0;
  constexpr int kTrials = 500;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Quotient q = quotients.next(0.6);
    constexpr double kNegligible = 1e-8;
    const Expanded found = expand(q, kNegligible);
    if (!found.resolved || found.powers.size() < q.numerator.size() + 4) {
      ++least;
      continue;
    }
    // with four degrees less even the best polynomial is off by more: nothing that the values at
    // Chebyshev points have can be nearer than the first coefficient left out over a few
    const std::size_t degree = found.powers.size() - 5;
    Real first = 0;
    constexpr int kPoints = 400;
    for (int j = 0; j < kPoints; ++j) {
      const Real angle = std::acos(-1.0L) * (j + 0.5L) / kPoints;
      first +=
          2 * q.at(std::cos(angle)) * std::cos(static_cast<Real>(degree + 1) * angle) / kPoints;
    }
    // pi / 4 of a coefficient is below the distance of any polynomial of less degree
    if (std::abs(first) * 0.78L > kNegligible) ++least;
  }
  EXPECT_GT(least, kTrials * 9 / 10);
}

TEST(QuotientPowers, RefusesWhatNeedsMoreThanThereIs) {
  Quotients quotients;
  std::size_t refused = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    Quotient q = quotients.next(0.95);
    const Expanded found = expand(q, 1e-10);
    if (found.resolved) {
      EXPECT_LE(found.powers.size(), kMostChebyshevDegree + 1);
      continue;
    }
    ++refused;
    EXPECT_GT(std::abs(q.h), 0.3);
  }
  EXPECT_GT(refused, 200);
  EXPECT_LT(refused, 900);
}

}  // namespace
}  // namespace hiac
