// Which of a file's steps is meant, and what is said where it has no such step.
#include "formats/common/mesh/steps.hpp"

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

const std::vector<double> kThreeTimes{0.3, 2, 10};

/// The step, or what is said.
std::string step_meant(const ReadOptions& options, const std::vector<double>& times) {
  try {
    const auto step = requested_step(options, times, "file");
    return step ? std::to_string(*step) : "any";
  } catch (const UsageError& error) {
    return error.what();
  }
}

std::string step_numbered(std::size_t step, const std::vector<double>& times = kThreeTimes) {
  ReadOptions options;
  options.step = step;
  return step_meant(options, times);
}

std::string step_at(double time, bool nearest = false,
                    const std::vector<double>& times = kThreeTimes) {
  ReadOptions options;
  options.time = time;
  options.nearest_time = nearest;
  return step_meant(options, times);
}

TEST(Steps, ByTheirNumber) {
  EXPECT_EQ(step_meant({}, kThreeTimes), "any");
  EXPECT_EQ(step_numbered(0), "0");
  EXPECT_EQ(step_numbered(2), "2");
  EXPECT_EQ(step_numbered(3), "step 3: file has no such step (0 to 2 expected)");
  EXPECT_EQ(step_numbered(0, {}), "0");
  EXPECT_EQ(step_numbered(1, {}), "step 1: file has no such step (0 to 0 expected)");
}

TEST(Steps, ByTheirTimeToSixDigits) {
  EXPECT_EQ(step_at(0.3), "0");
  EXPECT_EQ(step_at(2 * (1 + 0.9e-6)), "1");
  EXPECT_EQ(step_at(2 * (1 - 0.9e-6)), "1");
  EXPECT_NE(step_at(2 * (1 + 1.1e-6)), "1");
  EXPECT_EQ(step_at(0, false, {0, 1}), "0");
  EXPECT_EQ(step_at(-2, false, {-2, 2}), "0");
  const std::string hint = "; ReadOptions::nearest_time takes the nearest)";
  EXPECT_EQ(step_at(1), "time 1: file has no such time (its neighbours are 0.3 and 2" + hint);
  EXPECT_EQ(step_at(0.25),
            "time 0.25: file has no such time (its neighbours are 0.3, the first" + hint);
  EXPECT_EQ(step_at(11), "time 11: file has no such time (its neighbours are 10, the last" + hint);
  EXPECT_EQ(step_at(1, false, {}), "time 1: file tells no time");
  // in whatever order the file has them
  EXPECT_EQ(step_at(5, false, {10, 0.3, 2, 7}),
            "time 5: file has no such time (its neighbours are 2 and 7" + hint);
}

TEST(Steps, TheNearestTimeIfAsked) {
  EXPECT_EQ(step_at(1.1, true), "0");
  EXPECT_EQ(step_at(1.2, true), "1");
  EXPECT_EQ(step_at(-100, true), "0");
  EXPECT_EQ(step_at(100, true), "2");
  EXPECT_EQ(step_at(1.5, true, {1, 2}), "0");
}

TEST(Steps, TimesAreTextsOfFifteenDigits) {
  EXPECT_EQ(time_text(0.1 + 0.2), "0.3");
  EXPECT_EQ(time_text(1.0 / 3), "0.333333333333333");
  EXPECT_EQ(last_step_note(3, 0.1 + 0.2),
            "took the last of 3 steps, time 0.3 (ReadOptions::step and ReadOptions::time take "
            "another)");
}

}  // namespace
}  // namespace hiac::formats
