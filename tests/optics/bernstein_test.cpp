#include "hiac/optics/bernstein.hpp"

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace hiac {
namespace {

BernsteinPolynomial random_polynomial(std::mt19937_64& engine, std::size_t degree) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> c(degree + 1);
  for (double& v : c) v = uniform(engine);
  return BernsteinPolynomial(c);
}

TEST(BernsteinPolynomial, EvaluatesTheBernsteinSum) {
  const BernsteinPolynomial f(std::vector<double>{3, -1, 4});  // 3(1-t)^2 - 2t(1-t) + 4t^2
  EXPECT_EQ(evaluate(f, 0), 3);
  EXPECT_EQ(evaluate(f, 1), 4);
  EXPECT_DOUBLE_EQ(evaluate(f, 0.25), 3 * 0.5625 - 2 * 0.1875 + 4 * 0.0625);
}

TEST(BernsteinPolynomial, HalvesAndDerivativeAgreeWithIt) {
  std::mt19937_64 engine(1);
  for (std::size_t degree = 0; degree <= kMaxFieldDegree; ++degree) {
    const BernsteinPolynomial f = random_polynomial(engine, degree);
    const BernsteinHalves h = halves(f);
    const BernsteinPolynomial d = derivative(f);
    for (double t = 0; t <= 1; t += 0.0625) {
      EXPECT_NEAR(evaluate(h.front, t), evaluate(f, 0.5 * t), 1e-15);
      EXPECT_NEAR(evaluate(h.back, t), evaluate(f, 0.5 + 0.5 * t), 1e-15);
      const double step = 1e-5;
      const double quotient = (evaluate(f, t + step) - evaluate(f, t - step)) / (2 * step);
      EXPECT_NEAR(evaluate(d, t), quotient, 1e-5);
    }
  }
}

TEST(ChebyshevPolynomial, IsTheSameFunctionAsItsBernsteinForm) {
  std::mt19937_64 engine(2);
  for (std::size_t degree = 0; degree <= kMaxFieldDegree; ++degree) {
    const BernsteinPolynomial f = random_polynomial(engine, degree);
    const ChebyshevPolynomial g = chebyshev_from_bernstein(f);
    const BernsteinPolynomial back = bernstein_from_chebyshev({g.c.data(), degree + 1});
    const double conversion = 1e-15 * std::exp2(static_cast<double>(degree));
    for (std::size_t i = 0; i <= degree; ++i) EXPECT_NEAR(back.c[i], f.c[i], conversion);
    for (double t = 0; t <= 1; t += 0.0625)
      EXPECT_NEAR(evaluate(g, 2 * t - 1), evaluate(f, t), 1e-14) << degree;
  }
}

TEST(BernsteinPolynomial, OfPowersIsTheirSum) {
  std::mt19937_64 engine(4);
  for (std::size_t degree = 0; degree <= kMaxFieldDegree; ++degree) {
    const BernsteinPolynomial powers = random_polynomial(engine, degree);
    const BernsteinPolynomial f = bernstein_from_powers(powers.coefficients());
    ASSERT_EQ(f.degree, degree);
    for (double t = 0; t <= 1; t += 0.0625) {
      long double sum = 0;
      for (std::size_t k = degree + 1; k-- > 0;) sum = sum * (2 * t - 1) + powers.c[k];
      EXPECT_NEAR(evaluate(f, t), static_cast<double>(sum), 1e-14) << degree;
    }
  }
}

TEST(ChebyshevPolynomial, InterpolatesInExtendedPrecision) {
  for (std::size_t degree = 1; degree <= kMaxFieldDegree; ++degree) {
    BasicCoefficients<long double> values{};
    const auto f = [](long double t) { return std::exp(t / 8); };
    for (std::size_t j = 0; j <= degree; ++j)
      values[j] = f(chebyshev_point<long double>(j, degree));
    const auto g = chebyshev_interpolant(values, degree);
    const ExtendedBernstein b =
        bernstein_from_chebyshev(std::span<const long double>(g.c).first(degree + 1));
    // the remainder of interpolation, f^(n+1) / (n+1)! 4^-n, and more
    long double bound = 2;
    for (std::size_t k = 1; k <= degree + 1; ++k) bound *= 1 / (32 * static_cast<long double>(k));
    bound = bound * 4 + 1e-18L;
    for (long double t = 0; t <= 1; t += 0.0625L) {
      EXPECT_LT(std::abs(evaluate(g, 2 * t - 1) - f(t)), bound) << degree;
      EXPECT_LT(std::abs(evaluate(b, t) - f(t)), bound) << degree;
    }
  }
}

TEST(ChebyshevPolynomial, RestrictionIsTheSameFunctionOnAPart) {
  std::mt19937_64 engine(3);
  for (std::size_t degree = 0; degree <= kMaxFieldDegree; ++degree) {
    const BernsteinPolynomial f = random_polynomial(engine, degree);
    const ChebyshevPolynomial g = restricted(chebyshev_from_bernstein(f), 0.3, 0.45);
    for (double x = -1; x <= 1; x += 0.125)
      EXPECT_NEAR(evaluate(g, x), evaluate(f, 0.375 + 0.075 * x), 1e-14) << degree;
  }
}

TEST(ChebyshevPolynomial, EllipseBoundIsSharpWhereAllTermsAreLargestInOnePlace) {
  // every T_k is largest at the ellipse's right end
  for (const std::size_t degree : {std::size_t{0}, std::size_t{3}, kMaxFieldDegree + 1}) {
    ChebyshevPolynomial f;
    f.degree = degree;
    for (std::size_t k = 0; k <= degree; ++k) f.c[k] = 1 / static_cast<double>(k + 1);
    for (const double rho : {1.0, 1.5, 2.0, 4.0}) {
      const double tip = 0.5 * (rho + 1 / rho), value = evaluate(f, tip);
      const BasicBernsteinEllipse<double> ellipse(rho);
      EXPECT_NEAR(ellipse_bound(f, ellipse, 0), value, 1e-12 * value) << degree << ' ' << rho;
      EXPECT_NEAR(ellipse_bound(f, ellipse, 1), value - f.c[0], 1e-12 * value) << degree;
      EXPECT_EQ(ellipse_bound(f, ellipse, degree + 1), 0) << degree;
    }
    EXPECT_NEAR(magnitude_sum(f, 0), evaluate(f, 1), 1e-14) << degree;
  }
}

TEST(ChebyshevPolynomial, EllipseBoundTakesMagnitudes) {
  ChebyshevPolynomial f;
  f.degree = 2;
  f.c = {1, -2, -4};
  const BasicBernsteinEllipse<double> ellipse(2);
  EXPECT_EQ(ellipse_bound(f, ellipse, 0), 1 + 2 * 1.25 + 4 * 2.125);
  EXPECT_EQ(magnitude_sum(f, 0), 7);
  EXPECT_EQ(magnitude_sum(f, 2), 4);
}

TEST(BernsteinPolynomial, RefusesNoCoefficientsAndTooMany) {
  EXPECT_THROW(BernsteinPolynomial(std::vector<double>{}), std::invalid_argument);
  EXPECT_THROW(BernsteinPolynomial(std::vector<double>(kMaxFieldDegree + 2)),
               std::invalid_argument);
  EXPECT_THROW(bernstein_from_chebyshev(std::vector<double>{}), std::invalid_argument);
  EXPECT_THROW(bernstein_from_chebyshev(std::vector<double>(kMaxFieldDegree + 2)),
               std::invalid_argument);
  EXPECT_THROW(bernstein_from_chebyshev(std::vector<long double>(kMaxFieldDegree + 2)),
               std::invalid_argument);
  EXPECT_THROW(bernstein_from_powers(std::vector<double>{}), std::invalid_argument);
  EXPECT_THROW(bernstein_from_powers(std::vector<double>(kMaxFieldDegree + 2)),
               std::invalid_argument);
}

}  // namespace
}  // namespace hiac
