#include "hiac/scene/transfer_scale.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/specification.hpp"
#include "tests/scene/scene_text.hpp"

namespace hiac {
namespace {

Scene scene_of(const std::string& text) { return parse_scene(kLeast + text, "view.toml").scene; }

TEST(TransferScale, AFixedRangeStretchesPoints) {
  const Scene scene = scene_of(
      "[volume.color]\nfield = 'p'\nrange = [10, 20]\npoints = [[0, 1, 0, 0], [0.25, 0, 1, 0], [1, "
      "0, 0, 1]]\n[volume.extinction]\nfield = 'p'\nrange = [-1, 1]\npoints = [[0, 0], [1, 3]]\n");
  ASSERT_EQ(scene.volume.color->points.size(), 3U);
  EXPECT_EQ(scene.volume.color->points[0].scalar, 10);
  EXPECT_EQ(scene.volume.color->points[1].scalar, 12.5);
  EXPECT_EQ(scene.volume.color->points[2].scalar, 20);
  EXPECT_EQ(scene.volume.extinction->points[0].scalar, -1);
  EXPECT_EQ(scene.volume.extinction->points[1].scalar, 1);
}

TEST(TransferScale, RangesOfTheFieldWaitForIt) {
  const ParsedScene parsed = parse_scene(
      kLeast +
          "[volume.color]\nfield = 'p'\npreset = 'viridis'\n"
          "[volume.extinction]\nfield = 'p'\nrange = 'percentile:2.5,90'\nscale = 'log'\n"
          "points = [[0, 0], [1, 3]]\n",
      "view.toml");
  EXPECT_TRUE(parsed.scene.volume.color->points.empty());
  EXPECT_TRUE(parsed.scene.volume.extinction->points.empty());
  EXPECT_THROW(parsed.scene.volume.color->function(), std::invalid_argument);
  ASSERT_TRUE(parsed.color);
  EXPECT_EQ(parsed.color->percents, (std::array<double, 2>{0, 100}));
  EXPECT_FALSE(parsed.color->logarithmic);
  ASSERT_TRUE(parsed.extinction);
  EXPECT_EQ(parsed.extinction->percents, (std::array<double, 2>{2.5, 90}));
  EXPECT_TRUE(parsed.extinction->logarithmic);
  EXPECT_EQ(parsed.extinction->points[1].value[0], 3);
}

/// What a function of two points on 1e-3 to 1e3 is on a logarithmic scale.
double share(double scalar) { return (std::log10(scalar) + 3) / 6; }

TEST(TransferScale, ALogarithmicScaleIsLinearInTheLogarithm) {
  const std::string color = "[volume.color]\nfield = 'p'\nscale = 'log'\n";
  for (const std::string& keys :
       {std::string("range = [1e-3, 1e3]\npoints = [[0, 0, 0.5, 1], [1, 1, 0.25, 1]]\n"),
        std::string("points = [[1e-3, 0, 0.5, 1], [1e3, 1, 0.25, 1]]\n")}) {
    const auto transfer = *scene_of(color + keys).volume.color;
    const auto function = transfer.function();
    EXPECT_EQ(transfer.points.front().scalar, 1e-3);
    EXPECT_EQ(transfer.points.back().scalar, 1e3);
    EXPECT_LT(transfer.points.size(), 300U);
    double largest = 0;
    for (int i = 0; i <= 10000; ++i) {
      const double s = std::pow(10, -3 + 6e-4 * i);
      largest = std::fmax(largest, std::fabs(function(s)[0] - share(s)));
      EXPECT_NEAR(function(s)[1], 0.5 - 0.25 * share(s), 1e-4);
      EXPECT_EQ(function(s)[2], 1);
    }
    EXPECT_LE(largest, 1e-4);
    EXPECT_GT(largest, 1e-5);
  }
  const auto extinction = *scene_of(
                               "[volume.extinction]\nfield = 'p'\nscale = 'log'\nrange = [1e-3,"
                               " 1e3]\npoints = [[0, 0], [1, 500]]\n")
                               .volume.extinction;
  for (int i = 0; i <= 1000; ++i) {
    const double s = std::pow(10, -3 + 6e-3 * i);
    EXPECT_NEAR(extinction.function()(s)[0], 500 * share(s), 500e-4);
  }
}

TEST(TransferScale, ColorsAreDecodedWhereTheySaySo) {
  const auto color = [](const std::string& keys) {
    return *scene_of("[volume.color]\nfield = 'p'\n" + keys).volume.color;
  };
  const std::string points = "points = [[2, 0.5, 0, 0.02], [4, 1, 0, 0.02]]\n";
  EXPECT_EQ(color(points).points[0].value[0], 0.5);
  EXPECT_EQ(color(points + "color_space = 'linear'\n").points.size(), 2U);
  const auto decoded = color(points + "color_space = 'srgb'\n");
  EXPECT_NEAR(decoded.points[0].value[0], 0.21404114048223255, 1e-15);  // ((0.5+0.055)/1.055)^2.4
  EXPECT_NEAR(decoded.points[0].value[2], 0.02 / 12.92, 1e-15);
  EXPECT_NEAR(decoded.function()(3)[0], std::pow((0.75 + 0.055) / 1.055, 2.4), 8e-4);
  EXPECT_NEAR(color("color_space = 'srgb'\npoints = [[2, 0.5, 0, 0]]\n").points[0].value[0],
              0.21404114048223255, 1e-15);
  const std::string gray = "preset = 'grayscale'\nrange = [0, 1]\n";
  EXPECT_NEAR(color(gray).function()(0.5)[0], 0.21404114048223255, 9e-4);
  EXPECT_EQ(color(gray + "color_space = 'linear'\n").function()(0.5)[0], 0.5);
}

/// What a display value of 0 to 1 is as light (IEC 61966-2-1).
double light(double display) {
  return display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
}

// On a logarithmic scale a display value is even in the scalar's logarithm, however the points are
// given: at the geometric middle of two scalars it is the middle one.
TEST(TransferScale, DisplayValuesAreEvenInTheLogarithm) {
  const auto color = [](const std::string& keys) {
    return *scene_of("[volume.color]\nfield = 'p'\nscale = 'log'\n" + keys).volume.color;
  };
  const std::string absolute = "points = [[1e-2, 0, 0.1, 0.5], [10, 1, 0.9, 0.5]]\n";
  const std::string relative =
      "range = [1e-2, 10]\npoints = [[0, 0, 0.1, 0.5], [1, 1, 0.9, 0.5]]\n";
  for (const std::string& points : {absolute, relative}) {
    const auto display = color(points + "color_space = 'srgb'\n");
    EXPECT_EQ(display.points.front().scalar, 1e-2);
    EXPECT_EQ(display.points.back().scalar, 10);
    EXPECT_NEAR(display.function()(std::sqrt(1e-1))[0], light(0.5), 2e-3) << points;
    const auto linear = color(points + "color_space = 'linear'\n").function();
    EXPECT_NEAR(linear(std::sqrt(1e-1))[0], 0.5, 1e-4) << points;
    for (int i = 0; i <= 1000; ++i) {
      const double share = i / 1000.0, scalar = std::pow(10, -2 + 3 * share);
      const auto found = display.function()(scalar);
      EXPECT_NEAR(found[0], light(share), 2e-3) << points << scalar;
      EXPECT_NEAR(found[1], light(0.1 + 0.8 * share), 2e-3) << points << scalar;
      EXPECT_NEAR(found[2], light(0.5), 1e-12) << points << scalar;
      EXPECT_NEAR(linear(scalar)[1], 0.1 + 0.8 * share, 1e-4) << points << scalar;
    }
  }
  const auto gray = color("preset = 'grayscale'\nrange = [1e-2, 10]\n").function();
  EXPECT_NEAR(gray(std::sqrt(1e-1))[0], light(0.5), 2e-3);
}

// Points keep their scalars to the last bit, above all those of a step.
TEST(TransferScale, DecodedPointsKeepTheirScalars) {
  for (const std::string scale : {"linear", "log"}) {
    const auto color =
        *scene_of("[volume.color]\nfield = 'p'\ncolor_space = 'srgb'\nscale = '" + scale +
                  "'\npoints = [[0.1, 0, 0, 0], [0.3, 1, 0, 0.2], [0.3, 0, 1, 0.2], "
                  "[0.7, 1, 0, 0.3], [0.7, 0.5, 0.5, 0], [7.7, 0, 0, 1]]\n")
             .volume.color;
    const auto function = color.function();
    for (const double step : {0.3, 0.7}) {
      const auto below = function(std::nextafter(step, 0)), above = function(step);
      EXPECT_NEAR(below[0], 1, 1e-12) << scale << step;
      EXPECT_NEAR(above[1], step == 0.3 ? 1 : light(0.5), 1e-12) << scale << step;
    }
    EXPECT_TRUE(std::ranges::is_sorted(color.points, {}, [](const auto& p) { return p.scalar; }));
  }
}

}  // namespace
}  // namespace hiac
