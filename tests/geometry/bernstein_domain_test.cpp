#include "hiac/geometry/bernstein_domain.hpp"

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace hiac {
namespace {

using Factors = std::vector<BernsteinDomain::Factor>;
using Coordinates = std::array<double, 3>;

const std::vector<Factors> kDomains{{{1, 1}, {1, 1}}, {{1, 5}, {1, 4}}, {{1, 2}, {1, 3}, {1, 4}},
                                    {{2, 4}},         {{2, 7}},         {{2, 3}, {1, 2}},
                                    {{3, 0}},         {{3, 3}},         {{3, 5}},
                                    {{2, 1}, {1, 0}}};

double choose(int n, int k) {
  double product = 1;
  for (int i = 1; i <= k; ++i) product = product * (n - k + i) / i;
  return product;
}

// The product of the factors' Bernstein polynomials that belong to a grid point, at x.
double bernstein_at(const Factors& factors, const Coordinates& grid_point, const Coordinates& x) {
  double product = 1;
  std::size_t first = 0;
  for (const auto& [dimensions, degree] : factors) {
    const auto n = static_cast<int>(degree);
    int left = n;
    double rest = 1;
    for (std::size_t c = first; c < first + dimensions; ++c) {
      const int e = static_cast<int>(std::lround(grid_point[c] * n));
      product *= choose(left, e) * std::pow(x[c], e);
      left -= e;
      rest -= x[c];
    }
    product *= std::pow(rest, left);
    first += dimensions;
  }
  return product;
}

TEST(BernsteinDomain, PointsLieEvenlyInTheSimplices) {
  for (const Factors& factors : kDomains) {
    const BernsteinDomain domain(factors);
    std::size_t expected = 1;
    for (const auto& [dimensions, degree] : factors) {
      const auto n = static_cast<int>(degree), d = static_cast<int>(dimensions);
      expected *= static_cast<std::size_t>(std::lround(choose(n + d, d)));
    }
    ASSERT_EQ(domain.size(), expected);
    ASSERT_EQ(domain.points().size(), expected);
    for (std::size_t i = 0; i < domain.size(); ++i) {
      std::size_t first = 0;
      for (const auto& [dimensions, degree] : factors) {
        double sum = 0;
        for (std::size_t c = first; c < first + dimensions; ++c) {
          const double x = domain.points()[i][c] * static_cast<double>(degree);
          EXPECT_NEAR(x, std::round(x), 1e-14);
          EXPECT_GE(x, 0);
          sum += x;
        }
        EXPECT_LE(sum, static_cast<double>(degree) + 1e-14);
        first += dimensions;
      }
      for (std::size_t j = 0; j < i; ++j) EXPECT_NE(domain.points()[i], domain.points()[j]);
    }
  }
}

TEST(BernsteinDomain, CoefficientsAreThoseThatMadeTheValues) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const Factors& factors : kDomains) {
    const BernsteinDomain domain(factors);
    std::vector<double> coefficients(domain.size()), values(domain.size(), 0);
    for (double& c : coefficients) c = number(random);
    for (std::size_t i = 0; i < domain.size(); ++i)
      for (std::size_t k = 0; k < domain.size(); ++k)
        values[i] +=
            coefficients[k] * bernstein_at(factors, domain.points()[k], domain.points()[i]);
    domain.to_coefficients(values);
    for (std::size_t k = 0; k < domain.size(); ++k)
      EXPECT_NEAR(values[k], coefficients[k], 1e-15 * (10 + domain.condition()))
          << domain.size() << ' ' << k;
  }
}

// The largest sum of magnitudes of a row of the matrix that gives coefficients from values.
TEST(BernsteinDomain, TheConditionIsTheNormOfTheConversion) {
  for (const Factors& factors : kDomains) {
    const BernsteinDomain domain(factors);
    std::vector<double> sums(domain.size(), 0);
    for (std::size_t k = 0; k < domain.size(); ++k) {
      std::vector<double> unit(domain.size(), 0);
      unit[k] = 1;
      domain.to_coefficients(unit);
      for (std::size_t i = 0; i < domain.size(); ++i) sums[i] += std::abs(unit[i]);
    }
    const double norm = *std::max_element(sums.begin(), sums.end());
    EXPECT_NEAR(domain.condition(), norm, 1e-12 * norm) << domain.size();
    EXPECT_GE(domain.condition(), 1);
  }
}

}  // namespace
}  // namespace hiac
