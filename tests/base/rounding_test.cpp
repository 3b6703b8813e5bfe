#include "hiac/base/rounding.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace hiac {
namespace {

// Half an ulp of 1 is rounded to even; anything above is not.
template <class Real>
bool is_unit_roundoff(Real unit) {
  const volatile Real one = 1, half = unit, more = unit * Real(1.001);
  const volatile Real equal = one + half, larger = one + more;
  return equal == 1 && larger > 1;
}

TEST(Rounding, UnitsAreThoseOfTheArithmetic) {
  EXPECT_TRUE(is_unit_roundoff<double>(kUnit));
  EXPECT_EQ(kUnitOf<double>, kUnit);
  EXPECT_EQ(kUnitOf<long double>, kExtendedUnit);
  // that of longer mantissas is smaller than what is counted
  if (std::numeric_limits<long double>::digits <= 64) {
    EXPECT_TRUE(is_unit_roundoff<long double>(kExtendedUnit));
  }
  EXPECT_EQ(kExtendedIsFiner, kExtendedUnit < kUnit);
}

}  // namespace
}  // namespace hiac
