#include "tools/view/transfer/curve_axes.hpp"

#include <cmath>
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
}

TEST(Nearest, IsTheNearestWithinReach) {
  const std::vector<Place> items{{0, 0}, {10, 0}, {11, 0}};
  EXPECT_EQ(nearest(items, {9, 0}, 5), 1U);
  EXPECT_EQ(nearest(items, {10.8, 0}, 5), 2U);
  EXPECT_EQ(nearest(items, {5, 4.9}, 5), std::nullopt);
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
}

}  // namespace
}  // namespace hiac::view
