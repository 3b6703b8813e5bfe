#pragma once

#include <cmath>

#include <gtest/gtest.h>

namespace hiac::test {

/// Expects two values to be equal but for what their own evaluation rounds.
inline void expect_same(double value, double expected) {
  EXPECT_NEAR(value, expected, 1e-12 * std::abs(expected));
}

}  // namespace hiac::test
