#include "tools/view/viewport/step_choice.hpp"

#include <random>

#include <gtest/gtest.h>

namespace hiac::view {
namespace {

// Seconds of a picture: a part for the mesh, and a part for every pixel.
struct Cost {
  double mesh, pixel;
  [[nodiscard]] double of(ImageSize size, std::uint32_t step) const {
    return mesh + pixel * size.width * size.height / (static_cast<double>(step) * step);
  }
};

// The steps of pictures that are drawn one after the other, with times that vary by a tenth.
std::vector<std::uint32_t> steps(StepChoice& choice, const Cost& cost, ImageSize size, int count) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> noise(0.95, 1.05);
  std::vector<std::uint32_t> chosen;
  for (int k = 0; k < count; ++k) {
    chosen.push_back(choice.step(size));
    choice.took(cost.of(size, chosen.back()) * noise(random));
  }
  return chosen;
}

TEST(StepChoice, ShowsAllPixelsWhereTheyAreFastEnough) {
  StepChoice choice;
  EXPECT_EQ(steps(choice, {0.001, 5e-8}, {800, 600}, 10).back(), 1U);
}

TEST(StepChoice, HoldsTheTimeWhereAllPixelsAreTooSlow) {
  const ImageSize size{2000, 1500};
  // 0.6 s for all pixels, 0.0395 s for every fourth pixel of every fourth row
  const Cost cost{0.002, 2e-7};
  StepChoice choice;
  const std::uint32_t step = steps(choice, cost, size, 30).back();
  EXPECT_EQ(step, 4U);
  EXPECT_LE(cost.of(size, step), 1.1 * StepChoice::kSecondsPerFrame);
}

TEST(StepChoice, DoesNotFlicker) {
  for (const double pixel : {1e-8, 5e-8, 1.1e-7, 2e-7, 3e-7, 9e-7, 3e-6}) {
    StepChoice choice;
    const auto chosen = steps(choice, {0.01, pixel}, {1200, 900}, 60);
    int changes = 0;
    for (std::size_t k = 10; k < chosen.size(); ++k) changes += chosen[k] != chosen[k - 1] ? 1 : 0;
    EXPECT_LE(changes, 1) << pixel;
  }
}

TEST(StepChoice, IsNoCoarserThanTwoHundredByOneHundredAndFifty) {
  StepChoice choice;
  const std::uint32_t step = steps(choice, {1, 1e-5}, {800, 600}, 20).back();
  EXPECT_EQ(step, 4U);
}

TEST(StepChoice, FollowsAViewThatBecomesFaster) {
  StepChoice choice;
  const ImageSize size{1600, 1200};
  EXPECT_GT(steps(choice, {0.001, 5e-7}, size, 30).back(), 1U);
  EXPECT_EQ(steps(choice, {0.001, 1e-8}, size, 30).back(), 1U);
}

// The step of the next picture after pictures of the present one that took these seconds.
std::uint32_t step_after(StepChoice& choice, std::initializer_list<double> seconds) {
  for (const double took : seconds) choice.took(took);
  return choice.step({2000, 1500});
}

TEST(StepChoice, BeginsWithTheCoarsestPictureOfThirtyThousandPixels) {
  struct Case {
    ImageSize size;
    std::uint32_t step;
  };
  for (const Case& c : {Case{{600, 450}, 3},
                        {{599, 450}, 2},
                        {{800, 600}, 4},
                        {{1000, 750}, 5},
                        {{1000, 749}, 4},
                        {{10, 10}, 1},
                        {{2000, 1500}, 10},
                        {{70000, 70000}, 404}}) {
    StepChoice choice;
    EXPECT_EQ(choice.step(c.size), c.step) << c.size.width;
    EXPECT_EQ(choice.step(c.size), c.step) << c.size.width;  // nothing has been drawn yet
  }
}

TEST(StepChoice, IsFinerWhereThatTakesFourFifthsOfAFrameAtMost) {
  for (const auto& [seconds, step] : {std::pair(0.0323, 9U), {0.0325, 10U}}) {
    StepChoice choice;
    ASSERT_EQ(choice.step({2000, 1500}), 10U);
    EXPECT_EQ(step_after(choice, {seconds}), step);  // 100 / 81 as long: 0.04 s
  }
  StepChoice choice;
  ASSERT_EQ(choice.step({2000, 1500}), 10U);
  for (const std::uint32_t step : {9U, 8U, 7U, 6U, 5U, 4U, 3U, 2U, 1U, 1U})
    EXPECT_EQ(step_after(choice, {0.0001}), step);
}

TEST(StepChoice, IsCoarserWhereAPictureTakesSixFifthsOfAFrame) {
  for (const auto& [seconds, step] : {std::pair(0.0601, 10U), {0.0599, 9U}}) {
    StepChoice choice;
    ASSERT_EQ(choice.step({2000, 1500}), 10U);
    ASSERT_EQ(step_after(choice, {0.0323}), 9U);
    EXPECT_EQ(step_after(choice, {seconds}), step);
  }
  StepChoice choice;
  ASSERT_EQ(choice.step({2000, 1500}), 10U);
  EXPECT_EQ(step_after(choice, {7}), 10U);  // there is nothing coarser
}

TEST(StepChoice, CountsTheNewestPictureByTwoFifths) {
  for (const auto& [seconds, step] : {std::pair(0.1055, 10U), {0.1045, 9U}}) {
    StepChoice choice;
    ASSERT_EQ(choice.step({2000, 1500}), 10U);
    ASSERT_EQ(step_after(choice, {0.0323}), 9U);
    EXPECT_EQ(step_after(choice, {0.03, seconds}), step);
  }
}

TEST(StepChoice, ForgetsTimesOfAnotherSize) {
  StepChoice choice;
  ASSERT_EQ(choice.step({2000, 1500}), 10U);
  ASSERT_EQ(step_after(choice, {0.0001}), 9U);
  EXPECT_EQ(choice.step({600, 450}), 3U);  // its coarsest one
  ASSERT_EQ(choice.step({2000, 1500}), 10U);
  EXPECT_EQ(choice.step({2000, 1500}), 10U);
  choice.took(0.0001);
  choice.forget();
  EXPECT_EQ(choice.step({2000, 1500}), 10U);
}

}  // namespace
}  // namespace hiac::view
