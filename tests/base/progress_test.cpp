#include "hiac/base/progress.hpp"

#include <gtest/gtest.h>

#include "hiac/base/parallel.hpp"

namespace hiac {
namespace {

TEST(Progress, CountsUnitsFromAllThreads) {
  Progress progress;
  EXPECT_EQ(progress.state().stage, "");
  progress.begin("tiles", 1000);
  parallel_for(1000, 1, [&](IndexRange) { progress.advance(); });
  EXPECT_EQ(progress.state().stage, "tiles");
  EXPECT_EQ(progress.state().done, 1000U);
  EXPECT_EQ(progress.state().total, 1000U);
  progress.advance(5);
  EXPECT_EQ(progress.state().done, 1000U);
  progress.begin("write");
  EXPECT_EQ(progress.state().done, 0U);
  EXPECT_EQ(progress.state().total, 0U);
  EXPECT_GE(progress.state().seconds, 0);
}

TEST(Progress, TimeIsLeftInProportion) {
  EXPECT_EQ(seconds_left(1, 4, 10), 30);
  EXPECT_EQ(seconds_left(4, 4, 10), 0);
  EXPECT_FALSE(seconds_left(0, 4, 10));
  EXPECT_FALSE(seconds_left(1, 0, 10));
}

TEST(Progress, DurationsArePeoples) {
  EXPECT_EQ(duration_text(0.4), "0 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(59.6), "1 min 0 s");
  EXPECT_EQ(duration_text(3599), "59 min 59 s");
  EXPECT_EQ(duration_text(7384), "2 h 3 min");
  EXPECT_EQ(duration_text(-1), "0 s");
  EXPECT_EQ(duration_text(1e300), "277777 h 46 min");
}

}  // namespace
}  // namespace hiac
