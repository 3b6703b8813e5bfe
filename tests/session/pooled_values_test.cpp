#include "hiac/session/pooled_values.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace hiac {
namespace {

/// Values of many magnitudes and both signs, many of them more than once.
std::vector<double> values_of(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-30, 30), repeat(0, 3);
  std::vector<double> values;
  while (values.size() < count) {
    const double value = std::ldexp(mantissa(random), exponent(random));
    for (int k = repeat(random); k >= 0 && values.size() < count; --k) values.push_back(value);
  }
  return values;
}

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

// The truth is percentile() of one array of all values.
TEST(PooledValues, HaveThePercentilesOfAllValues) {
  for (const std::size_t in_memory : {0U, 150U, 100000U}) {
    PooledValues pool(false, in_memory);
    std::vector<double> all;
    for (std::uint64_t step = 0; step < 7; ++step) {
      const std::vector<double> values = values_of(97 + 13 * step, step);
      all.insert(all.end(), values.begin(), values.end());
      pool.add(values);
    }
    EXPECT_EQ(pool.count(), all.size());
    EXPECT_EQ(bits(pool.extent().low), bits(*std::ranges::min_element(all)));
    EXPECT_EQ(bits(pool.extent().high), bits(*std::ranges::max_element(all)));
    for (const double percent : {0.0, 0.1, 1.0, 25.0, 50.0, 77.7, 99.0, 99.9, 100.0})
      EXPECT_EQ(bits(pool.percentile(percent)), bits(percentile(all, percent)))
          << percent << " of " << in_memory << " in memory";
  }
}

TEST(PooledValues, FewValuesInTheFile) {
  for (const std::vector<double>& values :
       {std::vector<double>{3}, std::vector<double>{2, 1}, std::vector<double>{0, -0.0, -1e-310}}) {
    PooledValues pool(false, 0);
    pool.add(values);
    std::vector<double> copy = values;
    for (const double percent : {0.0, 30.0, 50.0, 90.0, 100.0})
      EXPECT_EQ(pool.percentile(percent), percentile(copy, percent)) << percent;
  }
}

TEST(PooledValues, ExtremesNeedNoValues) {
  PooledValues pool(true, 0);
  EXPECT_TRUE(pool.extent().empty());
  pool.add({});
  EXPECT_EQ(pool.count(), 0U);
  pool.add({4, -2});
  pool.add({7});
  EXPECT_EQ(pool.percentile(0), -2);
  EXPECT_EQ(pool.percentile(100), 7);
}

// The file is read in parts of 65536 values: one, one and a bit, and two.
TEST(PooledValues, TheFileMayHaveAnyNumberOfValues) {
  for (const std::size_t count : {65536U, 65537U, 131072U}) {
    PooledValues pool(false, 1000);
    std::vector<double> all = values_of(count, count);
    pool.add(all);
    EXPECT_EQ(pool.count(), count);
    for (const double percent : {0.001, 99.9995})
      EXPECT_EQ(bits(pool.percentile(percent)), bits(percentile(all, percent))) << count;
  }
}

TEST(PooledValues, RanksLieBetweenTheFirstAndTheLastValue) {
  for (const auto& [percent, count, below, share] :
       std::vector<std::tuple<double, std::size_t, std::size_t, double>>{{0, 5, 0, 0},
                                                                         {25, 5, 1, 0},
                                                                         {30, 6, 1, 0.5},
                                                                         {100, 5, 4, 0},
                                                                         {50, 2, 0, 0.5},
                                                                         {70, 1, 0, 0}}) {
    const PercentileRank rank = percentile_rank(percent, count);
    EXPECT_EQ(rank.below, below) << percent << " of " << count;
    EXPECT_DOUBLE_EQ(rank.share, share) << percent << " of " << count;
  }
  std::vector<double> values{9, -4, 6, 1, 2};
  EXPECT_EQ(percentile(values, 0), -4);
  EXPECT_EQ(percentile(values, 25), 1);
  EXPECT_EQ(percentile(values, 62.5), 4);  // half of the way from 2 to 6
  EXPECT_EQ(percentile(values, 100), 9);
}

}  // namespace
}  // namespace hiac
