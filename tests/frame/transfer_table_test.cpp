#include "hiac/frame/transfer_table.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"

namespace hiac {
namespace {

using testing::ElementsAre;

constexpr double kEndless = std::numeric_limits<double>::infinity();

ColorTransfer color_of(const std::string& field, std::vector<PiecewiseLinear<3>::Point> points) {
  ColorTransfer transfer;
  transfer.field = field;
  transfer.points = std::move(points);
  return transfer;
}

ExtinctionTransfer extinction_of(const std::string& field,
                                 std::vector<PiecewiseLinear<1>::Point> points) {
  ExtinctionTransfer transfer;
  transfer.field = field;
  transfer.points = std::move(points);
  return transfer;
}

Volume two_functions(const std::string& color_field, const std::string& extinction_field) {
  Volume volume;
  volume.color = color_of(color_field, {{0, {0, 0, 0}}, {2, {1, 0, 4}}});
  volume.extinction = extinction_of(extinction_field, {{1, {0}}, {2, {3}}, {4, {0}}});
  return volume;
}

TEST(TransferTable, FunctionsOfOneFieldAreCutAtTheBreakpointsOfBoth) {
  const OpticsTables tables = make_optics_tables(two_functions("p", "p"), Integration::exact);
  EXPECT_TRUE(tables.same_field);
  EXPECT_THAT(tables.color.lower, ElementsAre(-kEndless, 0, 1, 2, 4));
  EXPECT_THAT(tables.color.upper, ElementsAre(0, 1, 2, 4, kEndless));
  EXPECT_EQ(tables.extinction.lower, tables.color.lower);
  EXPECT_THAT(tables.color.anchor, ElementsAre(0, 0, 0, 2, 2));
  EXPECT_THAT(tables.color.slope[0], ElementsAre(0, 0.5, 0.5, 0, 0));
  EXPECT_THAT(tables.color.slope[2], ElementsAre(0, 2, 2, 0, 0));
  EXPECT_THAT(tables.color.value[2], ElementsAre(0, 0, 0, 4, 4));
  EXPECT_THAT(tables.extinction.slope[0], ElementsAre(0, 0, 3, -1.5, 0));
  EXPECT_THAT(tables.extinction.value[0], ElementsAre(0, 0, 0, 3, 0));
  EXPECT_THAT(tables.no_color, ElementsAre(1, 0, 0, 0, 0));
  EXPECT_THAT(tables.no_extinction, ElementsAre(1, 1, 0, 0, 1));
  EXPECT_EQ(tables.largest_color, 4);
}

TEST(TransferTable, FunctionsOfTwoFieldsHaveTheirOwnBreakpoints) {
  const OpticsTables tables = make_optics_tables(two_functions("p", "q"), Integration::exact);
  EXPECT_FALSE(tables.same_field);
  EXPECT_THAT(tables.color.lower, ElementsAre(-kEndless, 0, 2));
  EXPECT_THAT(tables.extinction.lower, ElementsAre(-kEndless, 1, 2, 4));
  EXPECT_EQ(tables.extinction.intervals(), 4U);
}

TEST(TransferTable, AMissingFunctionIsZeroEverywhere) {
  Volume volume = two_functions("p", "q");
  volume.color.reset();
  const OpticsTables tables = make_optics_tables(volume, Integration::exact);
  EXPECT_TRUE(tables.same_field);
  EXPECT_THAT(tables.no_color, ElementsAre(1, 1, 1, 1));
  EXPECT_EQ(tables.largest_color, 0);
}

TEST(TransferTable, IntegrationsHaveTheirRules) {
  const auto tables = [](Integration integration) {
    return make_optics_tables(two_functions("p", "p"), integration);
  };
  EXPECT_EQ(tables(Integration::exact).rule, PieceRule::exact);
  EXPECT_EQ(tables(Integration::gauss5).rule, PieceRule::five_points);
  EXPECT_EQ(tables(Integration::approximate).rule, PieceRule::mean_color);
  EXPECT_EQ(tables(Integration::approximate_unsliced).rule, PieceRule::mean_color);
  EXPECT_FALSE(tables(Integration::approximate).unsliced);
  EXPECT_TRUE(tables(Integration::approximate_unsliced).unsliced);
}

TEST(TransferTable, Has65535BreakpointsAtMost) {
  const auto with_breakpoints = [](std::size_t count) {
    Volume volume;
    std::vector<PiecewiseLinear<1>::Point> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back({static_cast<double>(i), {1}});
    volume.extinction = extinction_of("p", std::move(points));
    return make_optics_tables(volume, Integration::exact).extinction.intervals();
  };
  EXPECT_EQ(with_breakpoints(65535), 65536U);
  try {
    with_breakpoints(65536);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "transfer functions have more than 65535 breakpoints");
  }
}

TEST(TransferTable, ExtinctionIsLimitedWhereItRisesAbove) {
  Volume volume;
  volume.extinction = extinction_of("p", {{0, {0}}, {2, {8}}, {4, {0}}, {4, {9}}, {5, {2}}});
  const auto limited = [&](double most) {
    return make_optics_tables(volume, Integration::exact, most).extinction_function;
  };
  EXPECT_EQ(limited(9).breakpoints().size(), 4U);
  const PiecewiseLinear<1> four = limited(4);
  EXPECT_THAT(std::vector(four.breakpoints().begin(), four.breakpoints().end()),
              ElementsAre(0, 1, 2, 3, 4, testing::DoubleNear(4 + 5 / 7.0, 1e-15), 5));
  const std::pair<double, double> values[] = {{0.5, 2}, {1, 4}, {1.5, 4}, {2.5, 4}, {3, 4},
                                              {3.5, 2}, {4, 4}, {4.5, 4}, {5, 2},   {6, 2}};
  for (const auto& [scalar, value] : values) EXPECT_DOUBLE_EQ(four(scalar)[0], value) << scalar;
}

TEST(TransferTable, ALimitThatRoundsToTheLowerPointLiesBehindIt) {
  Volume volume;
  volume.extinction = extinction_of("p", {{1, {0}}, {2, {1e300}}});
  const auto function = make_optics_tables(volume, Integration::exact, 1).extinction_function;
  EXPECT_EQ(function.breakpoints()[1], std::nextafter(1.0, 2.0));
  EXPECT_EQ(function(1)[0], 0);
  EXPECT_EQ(function(1.5)[0], 1);
}

TEST(TransferTable, IsSteepBeyondThePrecisionOfFields) {
  OpticsTables tables = make_optics_tables(two_functions("p", "p"), Integration::exact);
  // the steepest slopes are 2 of colours, whose largest is 4, and 3 of the extinction
  EXPECT_FALSE(is_steep(tables, 0x1p41, 0, 1));
  EXPECT_TRUE(is_steep(tables, 0x1.0000000000001p41, 0, 1));
  EXPECT_FALSE(is_steep(tables, 0, 0x1p40 / 3, 1));
  EXPECT_TRUE(is_steep(tables, 0, 0x1p40, 0.5));
  EXPECT_FALSE(is_steep(tables, 0, 0x1p40, 0.25));
  EXPECT_TRUE(is_steep(tables, std::nan(""), 0, 1));
  EXPECT_TRUE(is_steep(tables, 0, kEndless, 0));
  tables.largest_color = 0.5;  // colours below 1 count as 1
  EXPECT_FALSE(is_steep(tables, 0x1p39, 0, 1));
  EXPECT_TRUE(is_steep(tables, 0x1.0000000000001p39, 0, 1));
}

TEST(TransferTable, ValuesLieInIntervalsOrOnBreakpoints) {
  const OpticsTables tables = make_optics_tables(two_functions("p", "q"), Integration::exact);
  const auto interval = [&](double value) {
    const ScalarIntervals found = classify_value(value, tables.extinction);
    return std::pair<int, int>(found.low, found.high);
  };
  EXPECT_EQ(interval(0.5), std::pair(0, 0));
  EXPECT_EQ(interval(1), std::pair(0, 1));
  EXPECT_EQ(interval(1.5), std::pair(1, 1));
  EXPECT_EQ(interval(2), std::pair(1, 2));
  EXPECT_EQ(interval(4), std::pair(2, 3));
  EXPECT_EQ(interval(4.5), std::pair(3, 3));
  const std::vector<double> values{0, 2, 9};
  const auto all = classify_values<3>(values, tables.color);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].low, 0);
  EXPECT_EQ(all[0].high, 1);
  EXPECT_EQ(all[1].low, 1);
  EXPECT_EQ(all[2].high, 2);
}

}  // namespace
}  // namespace hiac
