#include "hiac/scene/transfer_scale.hpp"

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

}  // namespace
}  // namespace hiac
