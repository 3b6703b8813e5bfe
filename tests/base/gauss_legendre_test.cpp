#include "hiac/base/gauss_legendre.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace hiac {
namespace {

TEST(GaussLegendre, IntegratesPowersUpToItsDegree) {
  for (std::size_t n = 1; n <= kMaxGaussNodes; ++n) {
    const GaussRule rule = gauss_legendre(n);
    ASSERT_EQ(rule.nodes.size(), n);
    for (std::size_t power = 0; power < 2 * n; ++power) {
      long double sum = 0;
      for (std::size_t i = 0; i < n; ++i)
        sum += rule.weights[i] *
               std::pow(static_cast<long double>(rule.nodes[i]), static_cast<long double>(power));
      const long double exact = power % 2 == 0 ? 2.0L / static_cast<long double>(power + 1) : 0;
      EXPECT_NEAR(static_cast<double>(sum), static_cast<double>(exact), 1e-15) << n << ' ' << power;
    }
  }
}

TEST(GaussLegendre, IntegratesPowersToExtendedPrecision) {
  for (std::size_t n = 1; n <= kMaxGaussNodes; ++n) {
    const auto rule = extended_gauss_legendre(n);
    for (std::size_t power = 0; power < 2 * n; power += 2) {
      long double error = -2.0L / static_cast<long double>(power + 1);
      for (std::size_t i = 0; i < n; ++i)
        error += rule.weights[i] * std::pow(rule.nodes[i], static_cast<long double>(power));
      EXPECT_LT(std::abs(error), 0x1p-60L) << n << ' ' << power;
    }
  }
}

TEST(GaussLegendre, NodesIncreaseAndAreSymmetric) {
  for (std::size_t n = 1; n <= kMaxGaussNodes; ++n) {
    const GaussRule rule = gauss_legendre(n);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_EQ(rule.nodes[i], -rule.nodes[n - 1 - i]);
      if (i == 0) continue;
      EXPECT_LT(rule.nodes[i - 1], rule.nodes[i]);
    }
  }
}

}  // namespace
}  // namespace hiac
