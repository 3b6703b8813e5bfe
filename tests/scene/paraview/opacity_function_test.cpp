#include "hiac/scene/paraview/opacity_function.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/scene/paraview/state_truth.hpp"

namespace hiac::test {
namespace {

using paraview::ExtinctionLaw;
using paraview::OpacityFunction;

OpacityFunction function_of(const std::string& name, double unit, ExtinctionLaw law) {
  const paraview::StateDocument state(state_file(name + ".pvsm"));
  const auto shown = state.all("representations", "UnstructuredGridRepresentation").front();
  return paraview::read_opacity_function(*state.referred(shown, "ScalarOpacityFunction"), unit,
                                         law);
}

/// Compares with ParaView's own opacities, which files hold to nine digits. The margin leaves out
/// scalars beside a step.
void expect_truth(const std::string& name, double unit, ExtinctionLaw law) {
  const OpacityFunction found = function_of(name, unit, law);
  const PiecewiseLinear<1> function(found.points);
  double largest = 0;
  for (const auto& point : found.points) largest = std::max(largest, point.value[0]);
  EXPECT_LE(found.bound, 1e-4 * largest);
  const auto rows = truth<2>(name, "opacity");
  EXPECT_GE(rows.size(), 100);
  for (const auto& [scalar, opacity] : rows) {
    const double expected =
        law == ExtinctionLaw::proportional ? opacity / unit : -std::log(1 - opacity) / unit;
    EXPECT_NEAR(function(found.axis.position(scalar))[0], expected,
                found.bound + 1e-7 * (1 + expected))
        << name << " at " << scalar;
  }
}

TEST(OpacityFunction, IsParaViewsOpacityOverTheUnitDistance) {
  for (const char* name : {"rgb", "log", "sharp"})
    expect_truth(name, 1.7, ExtinctionLaw::proportional);
}

TEST(OpacityFunction, IsTheLogarithmWhereParaViewResamples) {
  for (const char* name : {"rgb", "log", "sharp"})
    expect_truth(name, 0.7, ExtinctionLaw::exponential);
}

TEST(OpacityFunction, NeedsNoFurtherPointsForStraightLines) {
  const OpacityFunction function = function_of("rgb", 1, ExtinctionLaw::proportional);
  EXPECT_LE(function.points.size(), 7);
  EXPECT_LE(function.bound, 1e-15);
  EXPECT_FALSE(function.is_opaque);
}

TEST(OpacityFunction, IsFiniteWhereTheOpacityIsOne) {
  const OpacityFunction found = function_of("resample", 0.7, ExtinctionLaw::exponential);
  EXPECT_TRUE(found.is_opaque);
  const PiecewiseLinear<1> function(found.points);
  EXPECT_NEAR(function(200)[0], 24 * std::log(2.0) / 0.7, 1e-9);
  // close to there, too
  for (const double opacity : {0.5, 0.9, 0.99, 0.999})
    EXPECT_NEAR(function(40 + 160 * opacity)[0], -std::log(1 - opacity) / 0.7,
                1e-4 * 24 * std::log(2.0) / 0.7);
}

}  // namespace
}  // namespace hiac::test
