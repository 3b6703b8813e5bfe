#include "hiac/session/histogram/tetrahedron_shares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gmpxx.h>
#include <gtest/gtest.h>

#include "tests/support/instrumented.hpp"

namespace hiac {
namespace {

/// The share of a tetrahedron in which a linear field is below t, by divided differences of
/// truncated powers, which need distinct values: rational numbers tell them apart by 1e-200.
mpq_class share_below(const std::array<double, 4>& values, double t) {
  std::array<mpq_class, 4> v;
  mpq_class tiny(1);
  for (int i = 0; i < 200; ++i) tiny /= 10;
  for (std::size_t i = 0; i < 4; ++i) v[i] = mpq_class(values[i]) + static_cast<int>(i) * tiny;
  mpq_class below(0);
  for (std::size_t i = 0; i < 4; ++i) {
    const mpq_class distance = mpq_class(t) - v[i];
    if (distance <= 0) continue;
    mpq_class product(1);
    for (std::size_t j = 0; j < 4; ++j)
      if (j != i) product *= v[j] - v[i];
    below += distance * distance * distance / product;
  }
  return below;
}

struct Shares {
  std::vector<double> bins;
  std::array<double, 2> outside{};
};

Shares shares(const std::array<double, 4>& values, const std::vector<double>& edges) {
  Shares found{std::vector<double>(edges.size() - 1), {}};
  add_tetrahedron(values, 1, edges, found.bins, found.outside);
  return found;
}

/// Compares with rational numbers: relative to the share itself, however small.
void expect_exact(const std::array<double, 4>& values, const std::vector<double>& edges) {
  const Shares found = shares(values, edges);
  const auto near = [&](double share, const mpq_class& truth) {
    EXPECT_LE(abs(mpq_class(share) - truth), truth * mpq_class(2e-15) + mpq_class(1e-190))
        << values[0] << " " << values[1] << " " << values[2] << " " << values[3] << ": " << share
        << " instead of " << truth.get_d();
  };
  near(found.outside[0], share_below(values, edges.front()));
  near(found.outside[1], 1 - share_below(values, edges.back()));
  for (std::size_t k = 0; k + 1 < edges.size(); ++k)
    near(found.bins[k], share_below(values, edges[k + 1]) - share_below(values, edges[k]));
}

TEST(TetrahedronShares, AgreeWithRationalNumbers) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int round = 0; round < static_cast<int>(test::tried(3000)); ++round) {
    std::array<double, 4> values;
    for (double& v : values) v = uniform(random);
    // equal values, values an ulp apart, and values very close to one another
    const int close = round % 5;
    if (close == 1) values[1] = values[0];
    if (close == 2) values[2] = std::nextafter(values[3], 2);
    if (close == 3) values[1] = values[0] * (1 + 1e-9), values[2] = std::nextafter(values[1], 0);
    if (close == 4) values[0] = values[1] = values[2];
    std::vector<double> edges;
    for (int k = 0; k < 9; ++k) edges.push_back(uniform(random) * 1.2 - 0.1);
    // ends of bins at values, beside them, and where shares are tiny
    const double low = *std::ranges::min_element(values), high = *std::ranges::max_element(values);
    edges.insert(edges.end(), {low + 1e-4 * (high - low), high - 1e-5 * (high - low)});
    if (round % 2 == 0)
      edges.insert(edges.end(), {values[1], std::nextafter(values[1], 2), values[2]});
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    expect_exact(values, edges);
  }
}

TEST(TetrahedronShares, StandExtremeNumbers) {
  const double most = std::numeric_limits<double>::max(), least = 4.9406564584124654e-324;
  for (const std::array<double, 4>& values : {std::array<double, 4>{-most, most, 0, most / 2},
                                              {0, least, 2 * least, 3 * least},
                                              {0, least, 1, 2},
                                              {1e300, std::nextafter(1e300, 1e301), 0, -1e-300}}) {
    const double low = *std::ranges::min_element(values), high = *std::ranges::max_element(values);
    const Shares found = shares(values, {low, low / 2 + high / 2, high});
    EXPECT_NEAR(found.bins[0] + found.bins[1] + found.outside[0] + found.outside[1], 1, 4e-16)
        << low;
    EXPECT_GE(found.bins[0], 0);
    EXPECT_GE(found.bins[1], 0);
  }
}

TEST(TetrahedronShares, PutAConstantIntoOneBin) {
  EXPECT_EQ(shares({1, 1, 1, 1}, {0, 1, 2}).bins, (std::vector<double>{0, 1}));
  EXPECT_EQ(shares({2, 2, 2, 2}, {0, 1, 2}).bins, (std::vector<double>{0, 1}));
  EXPECT_EQ(shares({0, 0, 0, 0}, {0, 1, 2}).bins, (std::vector<double>{1, 0}));
  EXPECT_EQ(shares({-1, -1, -1, -1}, {0, 1, 2}).outside, (std::array<double, 2>{1, 0}));
  EXPECT_EQ(shares({3, 3, 3, 3}, {0, 1, 2}).outside, (std::array<double, 2>{0, 1}));
}

}  // namespace
}  // namespace hiac
