// What is known of a field in a cell, by hand: how steep its transfer function is there, which
// errors it may have, and on how much of a ray it is near a value, against samples.
#include "hiac/render/cells/cell_scalars.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/optics/bernstein.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac {
namespace {

constexpr double kSteep = std::numeric_limits<double>::infinity();

// Extinction with slopes 0, 4, 4, -2 and 0 and a step of 5 at 3; colours of slopes up to 3.
OpticsTables bent_optics(bool same_field) {
  Volume volume;
  volume.extinction = ExtinctionTransfer{"f", {{0, {1}}, {1, {5}}, {2, {9}}, {3, {7}}, {3, {12}}}};
  volume.color = ColorTransfer{same_field ? "f" : "g", {{0.5, {0, 1, 0}}, {1.5, {1, 0, 3}}}};
  return make_optics_tables(volume, Integration::exact);
}

TEST(SteepestSlope, IsThatOfTheIntervalsInTheRange) {
  const OpticsTables optics = bent_optics(false);
  ASSERT_EQ(optics.extinction.intervals(), 5U);
  const auto slope = [&](std::size_t low, std::size_t high) {
    return steepest_slope(optics.extinction, {low, high});
  };
  EXPECT_EQ(slope(0, 0), 0);
  EXPECT_EQ(slope(0, 1), 4);
  EXPECT_EQ(slope(1, 2), 4);
  EXPECT_EQ(slope(3, 3), 2);
  EXPECT_EQ(slope(2, 3), 4);
  EXPECT_EQ(slope(4, 4), 0);
  // a step inside the range
  EXPECT_EQ(slope(0, 4), kSteep);
  EXPECT_EQ(slope(3, 4), kSteep);
  // the steepest channel, in any interval
  EXPECT_EQ(steepest_slope(optics.color, {0, 0}), 0);
  EXPECT_EQ(steepest_slope(optics.color, {0, 2}), 3);
  EXPECT_EQ(steepest_slope(optics.color, {1, 1}), 3);
}

// Steps no larger than what both sides are rounded by are none.
TEST(SteepestSlope, DoesNotTakeRoundingForSteps) {
  TransferTable<1> table;
  table.lower = {-kSteep, 1};
  table.upper = {1, kSteep};
  table.anchor = {0, 1};
  table.slope[0] = {3, 2};
  table.value[0] = {1, 4};
  EXPECT_EQ(steepest_slope(table, {0, 1}), 3);
  constexpr double e = std::numeric_limits<double>::epsilon();
  table.value[0][1] = 4 + 60 * e;  // of 8 epsilon times 8
  EXPECT_EQ(steepest_slope(table, {0, 1}), 3);
  table.value[0][1] = 4 - 60 * e;
  EXPECT_EQ(steepest_slope(table, {0, 1}), 3);
  table.value[0][1] = 4 + 72 * e;
  EXPECT_EQ(steepest_slope(table, {0, 1}), kSteep);
  table.value[0][1] = 4 - 72 * e;
  EXPECT_EQ(steepest_slope(table, {0, 1}), kSteep);
  EXPECT_EQ(steepest_slope(table, {1, 1}), 2);
}

TEST(CellScalars, AreFlatWhereTheFunctionIs) {
  const OpticsTables optics = bent_optics(false);
  const auto is_flat_on = [&](double least, double most) {
    CellScalars scalars{};
    scalars.nodes.least = least;
    scalars.nodes.most = most;
    scalars.intervals = {classify_value(least, optics.extinction).low,
                         classify_value(most, optics.extinction).high};
    return is_flat(optics.extinction, scalars);
  };
  EXPECT_TRUE(is_flat_on(0.5, 0.5));
  EXPECT_FALSE(is_flat_on(0.5, 0.75));
  EXPECT_TRUE(is_flat_on(-3, -1));
  EXPECT_FALSE(is_flat_on(-3, 0.25));
  EXPECT_TRUE(is_flat_on(4, 9));
  EXPECT_FALSE(is_flat_on(2.5, 9));
}

// The errors' effects by hand: optical depth by slope times length, light by twice the largest
// colour of that, or by that of a whole ray; colours by their slope, over the length if they shine.
class AllowedErrorsTest : public testing::Test {
 protected:
  void view(Glow glow, const char* color_field, double color) {
    mesh_ = test::structured(1, test::Cut::bricks);
    test::add_node_field(mesh_, "f", [](const test::Position& p) { return p[0]; });
    test::add_node_field(mesh_, "g", [](const test::Position& p) { return p[1]; });
    Scene scene = test::cube_scene(Projection::orthographic, 4, 4);
    scene.volume.glow = glow;
    scene.volume.extinction = ExtinctionTransfer{"f", {{0, {0}}, {1, {5}}}};
    scene.volume.color = ColorTransfer{color_field, {{0, {0, 0, 0}}, {1, {0, 0, color}}}};
    projector_ = std::make_unique<const Projector>(scene.camera, scene.image);
    frame_ = std::make_unique<Frame>(mesh_, scene, *projector_);
    extinction_ = cell_scalars(mesh_, 0, frame_->extinction, frame_->optics.extinction);
    color_ = cell_scalars(mesh_, 0, frame_->color_field(), frame_->optics.color);
  }
  void allow() { set_allowed_errors(*frame_, 3, 1e-6, color_, extinction_); }

  ZooMesh mesh_;
  std::unique_ptr<const Projector> projector_;
  std::unique_ptr<Frame> frame_;
  CellScalars color_{}, extinction_{};
};

TEST_F(AllowedErrorsTest, OfReflectedLight) {
  view(Glow::chromaticity, "g", 7);
  allow();
  EXPECT_DOUBLE_EQ(extinction_.nodes.allowed, 1e-6 / (5 * 3 * 2 * 7));
  EXPECT_DOUBLE_EQ(color_.nodes.allowed, 1e-6 / 7);
  // alpha changes by the optical depth at least
  view(Glow::chromaticity, "g", 0.25);
  allow();
  EXPECT_DOUBLE_EQ(extinction_.nodes.allowed, 1e-6 / (5 * 3));
  // surfaces behind are seen through it
  frame_->isosurfaces.largest_light = 11;
  allow();
  EXPECT_DOUBLE_EQ(extinction_.nodes.allowed, 1e-6 / (5 * 3 * 22));
}

TEST_F(AllowedErrorsTest, OfEmittedLight) {
  view(Glow::emission, "g", 7);
  allow();
  EXPECT_DOUBLE_EQ(extinction_.nodes.allowed, 1e-6 / (5 * 3 * 7 * 3));
  EXPECT_DOUBLE_EQ(color_.nodes.allowed, 1e-6 / (7 * 3));
}

TEST_F(AllowedErrorsTest, OfOneFieldForBoth) {
  view(Glow::chromaticity, "f", 7);
  allow();
  EXPECT_DOUBLE_EQ(extinction_.nodes.allowed, 1e-6 / (5 * 3 * 14 + 7));
  EXPECT_EQ(color_.nodes.allowed, extinction_.nodes.allowed);
}

BernsteinPolynomial polynomial(const std::vector<double>& coefficients) {
  return BernsteinPolynomial(coefficients);
}

// The share of [0, 1] on which a polynomial is as near to a value.
double sampled_part(const BernsteinPolynomial& f, double value, double error) {
  constexpr int kSteps = 4000;
  int near = 0;
  for (int k = 0; k < kSteps; ++k)
    near += std::abs(evaluate(f, (k + 0.5) / kSteps) - value) <= error ? 1 : 0;
  return static_cast<double>(near) / kSteps;
}

// No less than where it is within the error, and mostly no more.
TEST(DoubtfulPart, IsWhereAPolynomialIsNearAValue) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<RootEnclosure> roots;
  std::vector<BasicRootEnclosure<long double>> extended_roots;
  double inside = 0;
  std::size_t exact = 0;
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<double> c(2 + static_cast<std::size_t>(trial) % 6);
    for (double& x : c) x = any(random);
    const double value = 0.6 * any(random), error = 0.05 * std::abs(any(random));
    const double least = sampled_part(polynomial(c), value, error);
    const double found = doubtful_part(polynomial(c), value, error, roots);
    EXPECT_GE(found, least - 1e-3) << trial;
    if (std::abs(found - least) < 1e-3) ++exact;
    const std::vector<long double> extended(c.begin(), c.end());
    EXPECT_NEAR(static_cast<double>(
                    doubtful_part(ExtendedBernstein(extended), value, error, extended_roots)),
                found, 1e-9);
    inside += found;
  }
  EXPECT_GT(inside, 2);
  EXPECT_GE(exact, 50U);
}

// All of it, none of it, and ends of it; before and behind by more than twice the error.
TEST(DoubtfulPart, OfLinesIsWhatTheyPass) {
  std::vector<RootEnclosure> roots;
  const auto part = [&](double from, double to, double value, double error) {
    return doubtful_part(polynomial({from, to}), value, error, roots);
  };
  EXPECT_NEAR(part(0, 4, 2, 0.5), 0.25, 1e-12);
  EXPECT_NEAR(part(4, 0, 2, 0.5), 0.25, 1e-12);
  EXPECT_NEAR(part(0, 4, 0, 0.5), 0.125, 1e-12);
  EXPECT_NEAR(part(0, 4, 4.25, 0.5), 0.0625, 1e-12);
  EXPECT_EQ(part(0, 4, 5, 0.5), 0);
  EXPECT_EQ(part(0, 4, -1, 0.5), 0);
  EXPECT_EQ(part(1.75, 2.25, 2, 0.5), 1);
  EXPECT_NEAR(part(0, 4, 2, 1e-6), 5e-7, 1e-12);
}

// Two pieces, of a quarter and the rest; the values are 1 to 5 in the cell. Steps of 2 and 5 at 1
// and 2, and one of 1 at 3 that the cell's intervals may leave out.
TEST(PolynomialDoubt, AddsUpTheStepsThatTheFieldIsNear) {
  Volume volume;
  volume.extinction =
      ExtinctionTransfer{"f", {{1, {1}}, {1, {3}}, {2, {3}}, {2, {8}}, {3, {8}}, {3, {9}}}};
  const OpticsTables optics = make_optics_tables(volume, Integration::exact);
  struct Piece {
    double begin, end;
    std::array<BernsteinPolynomial, 2> fields;
  };
  const std::vector<Piece> pieces{{0, 0.25, {polynomial({0}), polynomial({1, 2})}},
                                  {0.25, 1, {polynomial({0}), polynomial({2, 5})}}};
  std::vector<RootEnclosure> roots;
  const auto doubt = [&](double least, double most, double rounding = 0) {
    CellScalars scalars{};
    scalars.nodes.least = least;
    scalars.nodes.most = most;
    scalars.intervals = {classify_value(least, optics.extinction).low,
                         classify_value(most, optics.extinction).high};
    return polynomial_doubt(optics.extinction, rounding, scalars, pieces, 1, 0.01, 8.0, roots);
  };
  // 4 a unit on either piece; near 1 and 2 a part of 0.01 before or behind, of 3 both
  const double at_first = 2 * 0.01 / 4, at_second = 5 * 0.02 / 4, at_third = 1 * 0.02 / 4;
  EXPECT_EQ(doubt(1, 5).error, 0.01);
  EXPECT_NEAR(doubt(1, 5).jumped, 8 * (at_first + at_second + at_third), 1e-9);
  EXPECT_NEAR(doubt(1, 2.5).jumped, 8 * (at_first + at_second), 1e-9);
  EXPECT_NEAR(doubt(1.5, 5).jumped, 8 * (at_second + at_third), 1e-9);
  EXPECT_EQ(doubt(3.5, 5).jumped, 0);
  EXPECT_NEAR(doubt(0, 5).jumped, 8 * (at_first + at_second + at_third), 1e-9);
  // the smallest step is no more than rounding, then the next one
  EXPECT_NEAR(doubt(1, 5, 0.6).jumped, 8 * (at_first + at_second), 1e-9);
  EXPECT_NEAR(doubt(1, 5, 1.1).jumped, 8 * at_second, 1e-9);
}

}  // namespace
}  // namespace hiac
