#include "tools/view/transfer/curve_axes.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace hiac::view {
namespace {

const CurveAxes kAxes({50, 20, 450, 236}, {-2, 6}, {1e-3, 1e2});

TEST(CurveAxes, PutEndsAtEnds) {
  EXPECT_EQ(kAxes.x_of(-2), 50);
  EXPECT_EQ(kAxes.x_of(6), 450);
  EXPECT_EQ(kAxes.y_of(0), 236);
  EXPECT_NEAR(kAxes.y_of(1e-3), kAxes.zero_line(), 1e-9);
  EXPECT_NEAR(kAxes.y_of(1e2), 20, 1e-9);
  // a decade is as high as another
  EXPECT_NEAR(kAxes.y_of(1e-3) - kAxes.y_of(1e-2), kAxes.y_of(1) - kAxes.y_of(10), 1e-9);
}

TEST(CurveAxes, GoThereAndBack) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(50, 450), y(20, kAxes.zero_line());
  for (int i = 0; i < 1000; ++i) {
    const double at_x = x(random), at_y = y(random);
    EXPECT_NEAR(kAxes.x_of(kAxes.value_at(at_x)), at_x, 0.051);
    EXPECT_NEAR(kAxes.y_of(kAxes.extinction_at(at_y)), at_y, 0.051);
  }
}

TEST(CurveAxes, ReachZeroBelowTheGapAlone) {
  EXPECT_EQ(kAxes.extinction_at(236), 0);
  EXPECT_EQ(kAxes.extinction_at(kAxes.zero_line() + 0.5), 0);
  EXPECT_NEAR(kAxes.extinction_at(kAxes.zero_line()), 1e-3, 1e-12);
  EXPECT_EQ(kAxes.extinction_at(-1000), 1e2);  // the axis' end
}

TEST(CurveAxes, HaveAGapOfSixteenPixelsBelowTheLeastExtinction) {
  EXPECT_EQ(kAxes.zero_line(), 220);
  EXPECT_EQ(kAxes.y_of(-3), 236);
  EXPECT_EQ(kAxes.y_of(1e-9), 220);  // below the axis, but not zero
  EXPECT_EQ(kAxes.y_of(1e9), 20);
  // the middle of five decades
  EXPECT_NEAR(kAxes.y_of(std::pow(10, -0.5)), 120, 1e-9);
  EXPECT_NEAR(kAxes.extinction_at(120), std::pow(10, -0.5), 1e-3);
}

TEST(CurveAxes, SayNumbersOfATenthOfAPixel) {
  // the power of ten at or below a tenth of a pixel's width
  for (const auto& [width, unit] : {std::pair(400.0, 0.1),
                                    {399.0, 0.01},
                                    {40.0, 0.01},
                                    {3999.0, 0.1},
                                    {4000.0, 1.0},
                                    {4e5, 100.0}}) {
    const CurveAxes axes({0, 0, 400, 100}, {0, width}, {1, 10});
    for (const double x : {1.0 / 3, 123.457, 399.9}) {
      const double value = x * width / 400, found = axes.value_at(x);
      EXPECT_NEAR(found, std::round(value / unit) * unit, 1e-9 * width) << width << " " << x;
    }
  }
  // a plot without width has pixels of all its values
  const CurveAxes narrow({0, 0, 0.05, 100}, {0, 1}, {1, 10});
  EXPECT_EQ(narrow.value_at(0.0123456), 0.2);
}

TEST(CurveAxes, SayShortNumbers) {
  // a pixel is 0.02: a multiple of 0.001
  const double value = kAxes.value_at(123);
  EXPECT_EQ(value, std::round(value * 1000) / 1000);
  EXPECT_NEAR(value, -2 + 73 * 0.02, 1e-3);
}

TEST(CurveAxes, ZoomAroundAPlace) {
  const auto [low, high] = kAxes.zoomed(150, 0.5);  // the value there is 0
  EXPECT_DOUBLE_EQ(low, -1);
  EXPECT_DOUBLE_EQ(high, 3);
  const CurveAxes narrow({0, 0, 100, 100}, {1, 1 + 1e-15}, {1, 10});
  EXPECT_EQ(narrow.zoomed(50, 0.5), narrow.values());  // no further
}

TEST(CurveAxes, ZoomAsFarAsNumbersTellPixelsApart) {
  for (const double factor : {0.6, 0.4}) {  // to 1.2e-10 of the values, or to 0.8e-10
    const CurveAxes axes({0, 0, 100, 100}, {1, 1 + 2e-10}, {1, 10});
    const auto found = axes.zoomed(50, factor);
    EXPECT_EQ(found != axes.values(), factor == 0.6) << factor;
    const CurveAxes negative({0, 0, 100, 100}, {-1 - 2e-10, -1}, {1, 10});
    EXPECT_EQ(negative.zoomed(50, factor) != negative.values(), factor == 0.6) << factor;
  }
  const CurveAxes wide({0, 0, 100, 100}, {-1e308, 1e307}, {1, 10});
  EXPECT_EQ(wide.zoomed(50, 10), wide.values());  // no number is as large
  // at an end the other one alone moves
  EXPECT_EQ(kAxes.zoomed(50, 0.5), (std::array<double, 2>{-2, 2}));
  EXPECT_EQ(kAxes.zoomed(450, 0.5), (std::array<double, 2>{2, 6}));
}

const CurveAxes kLogAxes({50, 20, 450, 236}, {1e-3, 10}, {1e-3, 1e2}, TransferScale::log);

TEST(CurveAxes, PutDecadesOfValuesEvenly) {
  EXPECT_NEAR(kLogAxes.x_of(1e-3), 50, 1e-9);
  EXPECT_NEAR(kLogAxes.x_of(1e-2), 150, 1e-9);
  EXPECT_NEAR(kLogAxes.x_of(10), 450, 1e-9);
  EXPECT_NEAR(kLogAxes.value_along(0.25), 1e-2, 1e-15);
  for (const double value : {0.0, -0.0, -5.0}) EXPECT_LT(kLogAxes.x_of(value), 0);
}

TEST(CurveAxes, GoThereAndBackInDecades) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> x(50, 450);
  for (int i = 0; i < 1000; ++i) {
    const double at_x = x(random);
    EXPECT_NEAR(kLogAxes.x_of(kLogAxes.value_at(at_x)), at_x, 0.051);
  }
}

TEST(CurveAxes, ZoomAroundAPlaceInDecades) {
  const auto [low, high] = kLogAxes.zoomed(150, 0.5);  // the value there is 0.01
  EXPECT_NEAR(low, 1e-2 / std::sqrt(10), 1e-14);
  EXPECT_NEAR(high, 1e-2 * std::pow(10, 1.5), 1e-13);
  // as far out as numbers go, and no farther
  CurveAxes axes = kLogAxes;
  for (int i = 0; i < 40; ++i)
    axes = CurveAxes(axes.box(), axes.zoomed(250, 3), axes.extinctions(), TransferScale::log);
  EXPECT_GT(axes.values()[0], 0);
  EXPECT_TRUE(std::isfinite(axes.values()[1]));
  EXPECT_LT(axes.values()[0], 1e-100);
}

TEST(ShownLogValues, ArePositive) {
  const auto wide = shown_log_values({1e-2, 1e2});  // a fiftieth of four decades beside them
  ASSERT_TRUE(wide);
  EXPECT_NEAR(std::log10((*wide)[0]), -2.08, 1e-12);
  EXPECT_NEAR(std::log10((*wide)[1]), 2.08, 1e-12);
  const auto from_zero = shown_log_values({0, 100});
  ASSERT_TRUE(from_zero);
  EXPECT_NEAR(std::log10((*from_zero)[0]), 2 - kLogDecades - 0.02 * kLogDecades, 1e-12);
  EXPECT_EQ(shown_log_values({-3, 0}), std::nullopt);
  for (const std::array<double, 2> extent :
       {std::array<double, 2>{2, 2}, {-1e308, 1e308}, {5e-324, 5e-324}, {5e-324, 1.7e308}}) {
    const auto shown = shown_log_values(extent);
    ASSERT_TRUE(shown);
    EXPECT_GT((*shown)[0], 0);
    EXPECT_LT((*shown)[0], (*shown)[1]);
    EXPECT_TRUE(std::isfinite((*shown)[1]));
  }
}

std::vector<ExtinctionTransfer::Point> points(const std::vector<double>& extinctions) {
  std::vector<ExtinctionTransfer::Point> all;
  for (const double extinction : extinctions)
    all.push_back({static_cast<double>(all.size()), {extinction}});
  return all;
}

TEST(ExtinctionRange, HoldsAllThatIsPositive) {
  const auto [least, most] = extinction_range(points({0, 0.03, 7}));
  EXPECT_LE(least, 0.03);
  EXPECT_GT(most, 7);
  EXPECT_GE(most / least, 1e5 * 0.999);
  const auto wide = extinction_range(points({1e-300, 1e300}));
  EXPECT_GT(wide[1], 1e300);
  EXPECT_GT(wide[0], 0);
  for (const auto& extreme : {points({0}), points({5e-324}), points({1.7e308}), points({})}) {
    const auto range = extinction_range(extreme);
    EXPECT_TRUE(range[0] > 0 && range[0] < range[1] && std::isfinite(range[1]));
  }
}

TEST(ExtinctionRange, EndsAtPowersOfTen) {
  struct Case {
    std::vector<double> extinctions;
    int least, most;  // exponents
  };
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Case& c : {Case{{0.03, 7}, -3, 2},  // five at least
                        {{0.0003, 7}, -4, 2},
                        {{9.99}, -3, 2},
                        {{10}, -2, 3},
                        {{1e-8, 7}, -8, 2},
                        {{1e-13, 7}, -10, 2},           // twelve at most
                        {{7, infinity, -5, 0}, -3, 2},  // these are not shown
                        {{infinity}, -3, 2},
                        {{1e307}, 303, 308},
                        {{1e-305}, -307, -302},
                        {{5e-324}, -307, -302}}) {
    const auto range = extinction_range(points(c.extinctions));
    EXPECT_NEAR(std::log10(range[0]), c.least, 1e-9) << c.extinctions[0];
    EXPECT_NEAR(std::log10(range[1]), c.most, 1e-9) << c.extinctions[0];
  }
}

TEST(ShownValues, AreWiderByAFiftiethOnEitherSide) {
  const auto near = [](const std::array<double, 2>& extent, double low, double high) {
    const auto found = shown_values(extent);
    EXPECT_DOUBLE_EQ(found[0], low);
    EXPECT_DOUBLE_EQ(found[1], high);
  };
  near({1, 3}, 0.96, 3.04);
  near({-3, -1}, -3.04, -0.96);
  near({5, 5}, 2.5, 7.5);  // one value: half of it
  near({-5, -5}, -7.5, -2.5);
  near({0, 0}, -1, 1);
  near({1, 1 + 2.5e-9}, 1 - 5e-11, 1 + 2.55e-9);
  EXPECT_NEAR(shown_values({1, 1 + 1.5e-9})[0], 0.5, 1e-8);  // as good as one
}

TEST(ShownLogValues, AreCutToWhatHasARatio) {
  const auto ends = [](const std::array<double, 2>& extent) {
    const auto found = shown_log_values(extent).value();
    return std::array<double, 2>{std::log10(found[0]), std::log10(found[1])};
  };
  EXPECT_NEAR(ends({1e-200, 1e200})[0], -140 - 5.6, 1e-9);
  EXPECT_NEAR(ends({1e-200, 1e200})[1], 140 + 5.6, 1e-9);
  EXPECT_NEAR(ends({100, 100})[0], 1.5, 1e-9);  // one value: half a decade
  EXPECT_NEAR(ends({100, 100})[1], 2.5, 1e-9);
  EXPECT_NEAR(ends({1e-200, 1e-200})[0], -140.5, 1e-9);
}

TEST(ShownValues, AreNeverOneValue) {
  for (const std::array<double, 2>& extent :
       {std::array<double, 2>{0, 0}, {3, 3}, {-1e300, -1e300}, {0, 1}, {1, 1 + 1e-15}}) {
    const auto shown = shown_values(extent);
    EXPECT_LT(shown[0], extent[0]);
    EXPECT_GT(shown[1], extent[1]);
  }
}

TEST(WithNearby, TakesInWhatIsNear) {
  const std::vector<double> scalars{-0.4, 0.5, 1.25, 1.6, -9};
  EXPECT_EQ(with_nearby({0, 1}, scalars), (std::array<double, 2>{-0.4, 1.25}));
  EXPECT_EQ(with_nearby({0, 1}, {}), (std::array<double, 2>{0, 1}));
  // no farther than half of the width, of what was there at first
  EXPECT_EQ(with_nearby({3, 5}, std::vector<double>{2, 6, 1.9, 6.1}),
            (std::array<double, 2>{2, 6}));
}

TEST(Nearest, IsTheNearestWithinReach) {
  const std::vector<Place> items{{0, 0}, {10, 0}, {11, 0}};
  EXPECT_EQ(nearest(items, {9, 0}, 5), 1U);
  EXPECT_EQ(nearest(items, {10.8, 0}, 5), 2U);
  EXPECT_EQ(nearest(items, {5, 4.9}, 5), std::nullopt);
  EXPECT_EQ(nearest(items, {-3, -4}, 5), 0U);  // at the end of the reach
  EXPECT_EQ(nearest(items, {-3, -4}, 4.999), std::nullopt);
  EXPECT_EQ(nearest(items, {10.5, 0}, 5), 2U);  // of two as near the last
  EXPECT_EQ(nearest({}, {0, 0}, 5), std::nullopt);
}

TEST(BetweenNeighbors, StopsADragAtThem) {
  const auto all = points({1, 1, 1});
  EXPECT_EQ(between_neighbors<1>(all, 1, 0.5), 0.5);
  EXPECT_EQ(between_neighbors<1>(all, 1, -3), 0);
  EXPECT_EQ(between_neighbors<1>(all, 1, 7), 2);
  EXPECT_EQ(between_neighbors<1>(all, 0, -3), -3);
  EXPECT_EQ(between_neighbors<1>(all, 2, 7), 7);
}

TEST(HalfValueLength, HalvesTheLight) {
  EXPECT_NEAR(std::exp(-0.3 * *half_value_length(0.3)), 0.5, 1e-15);
  EXPECT_EQ(half_value_length(0), std::nullopt);
  EXPECT_EQ(half_value_length(-1), std::nullopt);
}

}  // namespace
}  // namespace hiac::view
