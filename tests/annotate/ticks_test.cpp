#include "hiac/annotate/ticks.hpp"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

namespace hiac {
namespace {

std::vector<std::string> labels_of(const std::vector<Tick>& ticks) {
  std::vector<std::string> labels;
  for (const Tick& tick : ticks) labels.push_back(tick.label);
  return labels;
}

TEST(Ticks, AreRoundNumbersInTheRange) {
  using testing::ElementsAre;
  EXPECT_THAT(labels_of(round_ticks(0, 1, 7)),
              ElementsAre("0.0", "0.2", "0.4", "0.6", "0.8", "1.0"));
  EXPECT_THAT(labels_of(round_ticks(-1.05, 1.9, 7)),
              ElementsAre("-1.0", "-0.5", "0.0", "0.5", "1.0", "1.5"));
  EXPECT_THAT(labels_of(round_ticks(0.1, 0.3, 3)), ElementsAre("0.1", "0.2", "0.3"));
  EXPECT_THAT(labels_of(round_ticks(273.15, 1273.15, 7)),
              ElementsAre("400", "600", "800", "1000", "1200"));
  EXPECT_THAT(labels_of(round_ticks(0, 3e7, 4)), ElementsAre("0", "1e+07", "2e+07", "3e+07"));
  EXPECT_THAT(labels_of(round_ticks(1e-9, 2e-9, 3)), ElementsAre("1.0e-09", "1.5e-09", "2.0e-09"));
  EXPECT_THAT(labels_of(round_ticks(1e6, 1e6 + 2, 3)),
              ElementsAre("1.000000e+06", "1.000001e+06", "1.000002e+06"));
}

TEST(Ticks, AreSeveralAndNotTooManyWhateverTheRange) {
  for (int exponent = -300; exponent <= 300; exponent += 7)
    for (const double low : {0.0, 1.0, -3.7, 12.3})
      for (const double extent : {1.0, 1.7, 2.3, 4.9, 9.99}) {
        const double scale = std::pow(10, exponent);
        const auto ticks = round_ticks(low * scale, (low + extent) * scale, 7);
        ASSERT_GE(ticks.size(), 2u) << low << " " << extent << " e" << exponent;
        ASSERT_LE(ticks.size(), 7u);
        for (std::size_t i = 0; i < ticks.size(); ++i) {
          EXPECT_GE(ticks[i].value, low * scale);
          EXPECT_LE(ticks[i].value, (low + extent) * scale);
          EXPECT_NEAR(std::stod(ticks[i].label) / scale, ticks[i].value / scale, 1e-6);
          if (i > 0) {
            EXPECT_NE(ticks[i].label, ticks[i - 1].label);
          }
        }
      }
}

TEST(Ticks, RoundBelow) {
  const std::pair<double, double> cases[] = {
      {1, 1},   {1.99, 1},     {2, 2},           {4.9, 2},   {5, 5},        {9.9, 5},
      {10, 10}, {0.2577, 0.2}, {3e-200, 2e-200}, {0.1, 0.1}, {1e300, 1e300}};
  for (const auto& [value, expected] : cases) EXPECT_EQ(round_below(value), expected) << value;
}

/// All numbers mantissa x 10^n in [low, high], by trying them.
std::vector<double> numbers_in(double low, double high, std::initializer_list<int> mantissas) {
  std::vector<double> found;
  for (int n = -30; n <= 30; ++n)
    for (const int mantissa : mantissas) {
      const double value = std::stod(std::to_string(mantissa) + "e" + std::to_string(n));
      if (value >= low * (1 - 1e-12) && value <= high * (1 + 1e-12)) found.push_back(value);
    }
  return found;
}

std::vector<double> values_of(const std::vector<Tick>& ticks) {
  std::vector<double> values;
  for (const Tick& tick : ticks) values.push_back(tick.value);
  return values;
}

TEST(LogarithmicTicks, AreDecadesOrElse125) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> exponent(-12, 12), decades(0.05, 6.5);
  int by_decades = 0, by_125 = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const double low = std::pow(10, exponent(random)), high = low * std::pow(10, decades(random));
    const std::vector<double> found = values_of(logarithmic_ticks(low, high, 7));
    const std::vector<double> powers = numbers_in(low, high, {1});
    const std::vector<double> round = numbers_in(low, high, {1, 2, 5});
    ASSERT_GE(found.size(), powers.size() >= 2 ? powers.size() : 1U);
    if (powers.size() >= 2) {
      ++by_decades;
      EXPECT_EQ(found, powers) << low << " " << high;
    } else if (round.size() >= 2) {
      ++by_125;
      EXPECT_EQ(found, round) << low << " " << high;
    }
  }
  EXPECT_GT(by_decades, 200);
  EXPECT_GT(by_125, 100);
}

TEST(LogarithmicTicks, SkipDecadesWhereThereAreMany) {
  using testing::ElementsAre;
  EXPECT_THAT(labels_of(logarithmic_ticks(0.01, 1000, 7)),
              ElementsAre("0.01", "0.1", "1", "10", "100", "1000"));
  EXPECT_THAT(labels_of(logarithmic_ticks(1e-9, 1e6, 7)),
              ElementsAre("1e-09", "1e-06", "0.001", "1", "1000", "1e+06"));
  EXPECT_THAT(labels_of(logarithmic_ticks(3, 60, 7)), ElementsAre("5", "10", "20", "50"));
  EXPECT_THAT(labels_of(logarithmic_ticks(1, 100, 2)), ElementsAre("1", "100"));
  for (const int count : {2, 3, 7})
    for (const double span : {1.5, 20.0, 1e5, 1e40, 1e200}) {
      const auto ticks = logarithmic_ticks(1.3e-100, 1.3e-100 * span, count);
      EXPECT_LE(ticks.size(), static_cast<std::size_t>(count)) << span;
      for (const Tick& tick : ticks)
        EXPECT_NEAR(std::stod(tick.label) / tick.value, 1, 1e-6) << tick.label;
    }
}

TEST(Ticks, AreTypesetWithAMinusSign) {
  EXPECT_EQ(typeset("-1.5e-07"), "\u22121.5e\u221207");
  EXPECT_EQ(typeset("12"), "12");
}

TEST(Ticks, AreWrittenPlainlyFromAMillionthToAMillion) {
  using testing::ElementsAre;
  EXPECT_THAT(labels_of(round_ticks(0, 999999, 3)), ElementsAre("0", "500000"));
  EXPECT_THAT(labels_of(round_ticks(0, 1e6, 3)), ElementsAre("0", "5.0e+05", "1.0e+06"));
  EXPECT_THAT(labels_of(round_ticks(-1e6, 0, 3)), ElementsAre("-1.0e+06", "-5.0e+05", "0"));
  EXPECT_THAT(labels_of(round_ticks(0, 3e-5, 4)),
              ElementsAre("0.00000", "0.00001", "0.00002", "0.00003"));
  EXPECT_THAT(labels_of(round_ticks(0, 3e-6, 4)), ElementsAre("0", "1e-06", "2e-06", "3e-06"));
}

TEST(LogarithmicTicks, AreWrittenPlainlyWhileTheyAreShort) {
  using testing::ElementsAre;
  EXPECT_THAT(labels_of(logarithmic_ticks(1e-6, 1e-3, 7)),
              ElementsAre("1e-06", "1e-05", "0.0001", "0.001"));
  EXPECT_THAT(labels_of(logarithmic_ticks(1e4, 1e7, 7)),
              ElementsAre("10000", "100000", "1e+06", "1e+07"));
}

TEST(Ticks, StepByOneTwoOrFive) {
  // the smallest such step with no more than as many numbers, by trying them all
  std::mt19937 random(8);
  std::uniform_real_distribution<double> place(-50, 50), size(0.1, 90);
  for (int trial = 0; trial < 300; ++trial) {
    const double low = place(random), high = low + size(random);
    const int count = 2 + trial % 6;
    std::vector<double> expected;
    for (int exponent = -3; expected.empty() && exponent < 4; ++exponent)
      for (const int mantissa : {1, 2, 5}) {
        const double step = mantissa * std::pow(10, exponent);
        const double first = std::ceil(low / step), last = std::floor(high / step);
        if (last - first + 1 > count || !expected.empty()) continue;
        for (double k = first; k <= last; ++k) expected.push_back(k * step);
      }
    const std::vector<double> found = values_of(round_ticks(low, high, count));
    ASSERT_EQ(found.size(), expected.size()) << low << " " << high << " " << count;
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-9);
  }
}

}  // namespace
}  // namespace hiac
