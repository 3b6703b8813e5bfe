#include "tools/common/steps/step_choice.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"

namespace hiac::tools {
namespace {

using Steps = std::vector<std::size_t>;

Steps chosen(const std::string& text, std::size_t count) {
  return StepChoice(text).among(count, "run.exo");
}

TEST(StepChoice, CountsFromTheFirstToTheLast) {
  EXPECT_EQ(chosen("all", 3), (Steps{0, 1, 2}));
  EXPECT_EQ(chosen("1:3", 5), (Steps{1, 2, 3}));
  EXPECT_EQ(chosen("2:2", 3), Steps{2});
  EXPECT_EQ(chosen("0:4:2", 5), (Steps{0, 2, 4}));
  EXPECT_EQ(chosen("0:5:2", 5), (Steps{0, 2, 4}));
  EXPECT_EQ(chosen("1:4:18446744073709551615", 5), Steps{1});
}

TEST(StepChoice, OfFilesThatHaveNumbers) {
  const Steps existing{3, 5, 7, 8};
  EXPECT_EQ(StepChoice("all").among(existing, "run-%d.zoo"), existing);
  EXPECT_EQ(StepChoice("3:7:2").among(existing, "run-%d.zoo"), (Steps{3, 5, 7}));
  EXPECT_THROW((void)StepChoice("3:7").among(existing, "run-%d.zoo"), UsageError);
}

TEST(StepChoice, RefusesOtherTextsAndMissingSteps) {
  for (const char* text : {"", "ALL", "1", "1:", ":2", "2:1", "0:3:0", "0:1:1:1", "-1:2", "0:2x",
                           "a:b", "0:99999999999999999999", " 0:1"})
    EXPECT_THROW(StepChoice{text}, UsageError) << text;
  EXPECT_THROW((void)chosen("0:3", 3), UsageError);
  EXPECT_THROW((void)chosen("0:18446744073709551615", 3), UsageError);
}

TEST(StepChoice, SaysWhatItExpects) {
  const auto told = [](const auto& work) -> std::string {
    try {
      work();
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  const auto told_of = [&](const char* text) { return told([&] { (void)StepChoice(text); }); };
  EXPECT_EQ(told_of("1"), "--steps 1: " + std::string(kStepsType) + " expected");
  EXPECT_EQ(told_of("1:2:3:4"), "--steps 1:2:3:4: " + std::string(kStepsType) + " expected");
  EXPECT_EQ(told_of("2:1"), "--steps 2:1: FIRST is above LAST");
  EXPECT_EQ(told_of("2:2"), "");
  EXPECT_EQ(told_of("0:3:0"), "--steps 0:3:0: STRIDE is at least 1");
  EXPECT_EQ(told([] { (void)chosen("0:3", 3); }),
            "--steps 0:3: run.exo has no step 3 (3 steps from 0 to 2 found)");
  const Steps existing{3, 5, 7, 8};
  EXPECT_EQ(told([&] { (void)StepChoice("3:7").among(existing, "run-%d.zoo"); }),
            "--steps 3:7: run-%d.zoo has no step 4 (4 steps from 3 to 8 found)");
}

}  // namespace
}  // namespace hiac::tools
