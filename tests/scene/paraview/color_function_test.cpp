#include "hiac/scene/paraview/color_function.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "hiac/scene/paraview/ciede2000_path.hpp"
#include "tests/scene/paraview/state_truth.hpp"

namespace hiac::test {
namespace {

using paraview::ColorFunction;

using paraview::ColorSteps;

ColorFunction function_of(const std::string& name, ColorSteps steps = ColorSteps::taken) {
  const paraview::StateDocument state(state_file(name + ".pvsm"));
  return paraview::read_color_function(state.all("lookup_tables", "PVLookupTable").front(), steps);
}

/// The largest difference of a channel from ParaView's colours.
double largest_error(const std::string& name) {
  const ColorFunction function = function_of(name);
  double error = 0;
  const auto rows = truth<4>(name, "color");
  EXPECT_EQ(rows.size(), 1000);
  for (const auto& [scalar, r, g, b] : rows) {
    // there a step of 1e-4 leads from the node's colour to the converted one
    if (function.axis.log_range && scalar == function.axis.log_range->front()) continue;
    const auto found = function.at(scalar);
    error = std::max(
        {error, std::fabs(found[0] - r), std::fabs(found[1] - g), std::fabs(found[2] - b)});
  }
  return error;
}

TEST(ColorFunction, IsParaViewsInEveryColourSpace) {
  for (const char* name : {"rgb", "hsv0", "hsv1", "lab", "diverging", "step", "log"})
    EXPECT_LE(largest_error(name), 1e-6) << name;
}

TEST(ColorFunction, StatesItsBound) {
  EXPECT_EQ(function_of("rgb").bound, 0);
  EXPECT_GT(function_of("lab").bound, 0);
  // CIELAB's formulas jump by less than 2e-6 where they switch
  EXPECT_LE(function_of("lab").bound, 2e-6);
}

TEST(ColorFunction, FollowsTheShortestPathWithinParaViewsBytes) {
  // ParaView rounds the colours of this space to bytes
  EXPECT_LE(largest_error("ciede2000"), 0.5 / 255 + 1e-6);
}

TEST(ColorFunction, HasTheStepsOfATable) {
  for (const auto& [name, low, high, logarithmic] :
       {std::tuple{"table", 40.0, 260.0, false}, std::tuple{"logtable", 2.0, 2000.0, true}}) {
    const ColorFunction function = function_of(name);
    const auto rows = truth<3>(name, "table");
    ASSERT_EQ(function.points.size(), 2 * rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (const double inside : {0.001, 0.5, 0.999}) {
        const double share = (static_cast<double>(k) + inside) / static_cast<double>(rows.size());
        const double at =
            logarithmic ? low * std::pow(high / low, share) : low + share * (high - low);
        // ParaView's powers of ten may end beyond the range, where colours are not converted
        const bool is_end = logarithmic && (k == 0 || k + 1 == rows.size());
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(function.at(at)[c], rows[k][c], is_end ? 1e-4 : 1e-6) << name << " " << k;
      }
  }
}

TEST(ColorFunction, IsTheFunctionBehindATableWhoseStepsAreIgnored) {
  const ColorFunction function = function_of("table", ColorSteps::ignored);
  for (const auto& [scalar, r, g, b] : truth<4>("table", "color"))
    EXPECT_NEAR(function.at(scalar)[1], g, 1e-6);
}

// Pairs 1, 7, 17, 25 and 34 of Sharma, Wu and Dalal's table of test data.
TEST(Ciede2000, HasThePublishedDifferences) {
  using paraview::ciede2000;
  EXPECT_NEAR(ciede2000({50, 2.6772, -79.7751}, {50, 0, -82.7485}), 2.0425, 5e-5);
  EXPECT_NEAR(ciede2000({50, 0, 0}, {50, -1, 2}), 2.3669, 5e-5);
  EXPECT_NEAR(ciede2000({50, 2.5, 0}, {73, 25, -18}), 27.1492, 5e-5);
  EXPECT_NEAR(ciede2000({60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}), 1.2644, 5e-5);
  EXPECT_NEAR(ciede2000({2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}), 0.9082, 5e-5);
}

}  // namespace
}  // namespace hiac::test
