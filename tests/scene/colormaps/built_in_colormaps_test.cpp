#include "hiac/scene/colormaps/built_in_colormaps.hpp"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/image/srgb.hpp"

namespace hiac {
namespace {

using testing::ElementsAre;

struct Published {
  const char* name;
  double scalar;
  std::array<double, 3> rgb;
};

/// Entries of matplotlib's tables, as published with six digits, and nodes of ParaView's maps, of
/// which VTK's conversion to Msh and back keeps four digits.
constexpr Published kPublished[] = {{"viridis", 0, {0.267004, 0.004874, 0.329415}},
                                    {"viridis", 128 / 255.0, {0.127568, 0.566949, 0.550556}},
                                    {"viridis", 1, {0.993248, 0.906157, 0.143936}},
                                    {"plasma", 37 / 255.0, {0.331426, 0.006261, 0.641316}},
                                    {"inferno", 200 / 255.0, {0.985952, 0.61575, 0.025592}},
                                    {"magma", 128 / 255.0, {0.716387, 0.214982, 0.47529}},
                                    {"cividis", 0, {0, 0.135112, 0.304751}},
                                    {"cividis", 200 / 255.0, {0.769353, 0.707035, 0.408516}},
                                    {"turbo", 37 / 255.0, {0.2768, 0.47151, 0.94214}},
                                    {"turbo", 1, {0.4796, 0.01583, 0.01055}},
                                    {"Cool to Warm", 0.5, {0.865003, 0.865003, 0.865003}},
                                    {"coolwarm", 1, {0.705882, 0.0156863, 0.14902}},
                                    {"black-body", 0.4, {0.901961, 0, 0}},
                                    {"Grayscale", 0.25, {0.25, 0.25, 0.25}},
                                    {"jet", 0.5, {0.5 + 0.25 / 8, 1, 0.5 - 0.25 / 8}},
                                    {"rainbow", 0.5, {0, 1, 0}}};

TEST(BuiltInColormaps, AreThePublishedOnes) {
  for (const Published& entry : kPublished) {
    const auto preset = built_in_colormap(entry.name);
    ASSERT_TRUE(preset) << entry.name;
    const auto rgb = preset_color(*preset, entry.scalar);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(rgb[c], entry.rgb[c], 2e-4) << entry.name << ' ' << entry.scalar << ' ' << c;
  }
  EXPECT_FALSE(built_in_colormap("virids"));
  EXPECT_FALSE(built_in_colormap(""));
}

TEST(BuiltInColormaps, AreKnownByTheNamesThatAreListed) {
  EXPECT_THAT(built_in_colormap_names(),
              ElementsAre("viridis", "plasma", "inferno", "magma", "cividis", "turbo",
                          "cool to warm", "black body", "grayscale", "jet", "rainbow"));
  for (const std::string& name : built_in_colormap_names()) {
    const auto preset = built_in_colormap(name);
    ASSERT_TRUE(preset) << name;
    EXPECT_EQ(preset->name, name);
    EXPECT_EQ(preset->nodes.front().scalar, 0);
    EXPECT_EQ(preset->nodes.back().scalar, 1);
  }
}

TEST(BuiltInColormaps, AreLinearizedWithinTheProvenBound) {
  constexpr int kSamples = 5003;
  for (const std::string& name : built_in_colormap_names())
    for (const double tolerance : {1e-2, 1e-3, 1e-5}) {
      const ColormapPreset preset = *built_in_colormap(name);
      const LinearizedPreset linear = linearize(preset, 0, 1, tolerance, ColorEncoding::srgb);
      EXPECT_LE(linear.bound, tolerance) << name;
      const PiecewiseLinear<3> function(linear.points);
      double largest = 0;
      for (int i = 0; i <= kSamples; ++i) {
        const double s = static_cast<double>(i) / kSamples;
        for (std::size_t c = 0; c < 3; ++c)
          largest = std::fmax(largest,
                              std::fabs(srgb_encode(function(s)[c]) - preset_color(preset, s)[c]));
      }
      EXPECT_LE(largest, linear.bound) << name << ' ' << tolerance;
      EXPECT_GT(largest, tolerance / 100) << name << ": more points than needed";
    }
}

TEST(BuiltInColormaps, NeedFewPoints) {
  for (const std::string& name : built_in_colormap_names()) {
    const auto linear = linearize(*built_in_colormap(name), 0, 1, 1e-3, ColorEncoding::srgb);
    EXPECT_LT(linear.points.size(), 150U) << name;
  }
}

TEST(BuiltInColormaps, DecodedStepsStayWhereTheyAre) {
  const ColormapPreset steps{
      "",
      ColorSpace::rgb,
      {{0, {0, 0, 0}}, {0.5, {0.2, 0, 0}}, {0.5, {0.8, 1, 0}}, {1, {1, 1, 1}}}};
  const LinearizedPreset linear = linearize(steps, 0, 1, 1e-3, ColorEncoding::srgb);
  const PiecewiseLinear<3> function(linear.points);
  EXPECT_NEAR(function(0.5)[0], srgb_decode(0.8), 1e-12);
  EXPECT_NEAR(function(0.5 - 1e-9)[0], srgb_decode(0.2), 1e-6);
  EXPECT_EQ(function(1)[2], 1);
}

}  // namespace
}  // namespace hiac
