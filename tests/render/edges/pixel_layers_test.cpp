// Layers of strips over a pixel against samples.

#include "hiac/render/edges/pixel_layers.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/render/truth/sampled_strips.hpp"

namespace hiac {
namespace {

TEST(StripSamples, AreThoseThatTheStripCovers) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-2, 2), width(0.1, 2.5);
  int most = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Strip strip{place(random), place(random), place(random), place(random), width(random)};
    const test::SampledStrip sampled(strip);
    const double expected = test::sampled_mean(
        0.25, -0.5, [&](double x, double y) { return sampled.holds(x, y) ? 1 : 0; });
    const int found = count(strip_samples(strip, 0.25, -0.5));
    most = std::max(most, std::abs(found - static_cast<int>(std::lround(expected * 64 * 64))));
  }
  EXPECT_LE(most, 1);  // on the strip's very border
  EXPECT_EQ(count(strip_samples({-3, 0, 3, 0, 1}, 0, 0)), 64 * 64);
  EXPECT_EQ(count(strip_samples({0.25, -3, 0.25, 3, 0.5}, 0, 0)), 64 * 32);
  EXPECT_EQ(count(strip_samples({1, 1, 1, 1, 2}, 1, 1)), 0);
}

// Strips near the pixel at the origin, in layers.
std::vector<std::vector<Strip>> random_layers(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-1.5, 1.5), width(0.1, 1);
  std::vector<std::vector<Strip>> layers(2 + random() % 4);
  for (auto& layer : layers)
    for (std::size_t k = 0; k <= random() % 3; ++k)
      layer.push_back({place(random), place(random), place(random), place(random), width(random)});
  return layers;
}

TEST(PixelLayers, LetThroughWhatNoneCovers) {
  std::mt19937 random(3);
  for (const double opacity : {1.0, 0.6, 0.05, 0.0}) {
    double largest = 0;
    for (int trial = 0; trial < 300; ++trial) {
      const auto layers = random_layers(random);
      PixelLayers found;
      std::vector<std::vector<test::SampledStrip>> near;
      double passed = 1;
      for (std::size_t n = 0; n < layers.size(); ++n) {
        PixelSamples covered;
        for (const Strip& strip : layers[n]) covered |= strip_samples(strip, 0, 0);
        near.push_back(test::strips_near(layers[n], 0, 0));
        passed *= 1 - found.add(covered, test::sampled_coverage(layers[n], 0, 0), opacity);
        const double expected = test::sampled_mean(0, 0, [&](double x, double y) {
          double through = 1;
          for (const auto& layer : near)
            if (test::any_holds(layer, x, y)) through *= 1 - opacity;
          return through;
        });
        largest = std::max(
            {largest, std::abs(found.transparency() - expected), std::abs(passed - expected)});
      }
    }
    EXPECT_LE(largest, 0.002) << opacity;
  }
}

TEST(PixelLayers, OfOneStripHideNothingTwice) {
  PixelLayers layers;
  const PixelSamples left = strip_samples({-0.25, -3, -0.25, 3, 0.5}, 0, 0);
  EXPECT_EQ(layers.add(left, 0.5, 1), 0.5);
  EXPECT_EQ(layers.add(left, 0.5, 1), 0);
  EXPECT_EQ(layers.add(strip_samples({0.25, -3, 0.25, 3, 0.5}, 0, 0), 0.5, 1), 1);
  EXPECT_EQ(layers.transparency(), 0);
}

TEST(PixelLayers, HairlinesBetweenSamplesCount) {
  PixelLayers layers;
  const Strip hair{-3, 0, 3, 0, 1e-3};
  EXPECT_EQ(count(strip_samples(hair, 0, 0)), 0);
  EXPECT_DOUBLE_EQ(layers.add(strip_samples(hair, 0, 0), 1e-3, 1), 1e-3);
  EXPECT_DOUBLE_EQ(layers.transparency(), 1 - 1e-3);
}

}  // namespace
}  // namespace hiac
