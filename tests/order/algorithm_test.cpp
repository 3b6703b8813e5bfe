#include "hiac/order/algorithm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"

namespace hiac {
namespace {

TEST(OrderAlgorithm, NamesAreReadBack) {
  for (const OrderAlgorithm algorithm : kOrderAlgorithms)
    EXPECT_EQ(parse_algorithm(algorithm_name(algorithm), "--algorithm"), algorithm);
  EXPECT_EQ(algorithm_name(OrderAlgorithm::multitiled), "multitiled");
}

TEST(OrderAlgorithm, UnknownNamesAreRefusedWithTheKnownOnes) {
  try {
    parse_algorithm("quick", "--algorithm");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(),
                 "--algorithm: unknown algorithm (exact, stein, multitiled, mpvo, centroid "
                 "expected, `quick` found)");
  }
  EXPECT_THROW(parse_algorithm("", "--algorithm"), UsageError);
}

}  // namespace
}  // namespace hiac
