#include "hiac/base/finite_range.hpp"

#include <array>
#include <limits>

#include <gtest/gtest.h>

namespace hiac {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(FiniteRange, SpansTheFiniteNumbersAndCountsTheOthers) {
  const std::array values{kNaN, 3.0, -kInfinity, -2.0, kInfinity, 5.0, kNaN, 0.0};
  const FiniteRange range{values};
  EXPECT_EQ(range.low, -2);
  EXPECT_EQ(range.high, 5);
  EXPECT_EQ(range.not_finite, 4U);
  EXPECT_FALSE(range.empty());
}

TEST(FiniteRange, OneNumberIsARange) {
  FiniteRange range;
  range.include(-7);
  EXPECT_FALSE(range.empty());
  EXPECT_EQ(range.low, -7);
  EXPECT_EQ(range.high, -7);
}

TEST(FiniteRange, IsEmptyWithoutAFiniteNumber) {
  EXPECT_TRUE(FiniteRange().empty());
  const std::array values{kNaN, kInfinity, -kInfinity};
  const FiniteRange range{values};
  EXPECT_TRUE(range.empty());
  EXPECT_EQ(range.not_finite, 3U);
}

}  // namespace
}  // namespace hiac
