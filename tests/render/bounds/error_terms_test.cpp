// Every term of the bounds by itself: what the model of error_bound.hpp comes to where all the
// others are nothing, and, where a worst case can be built, the error that it bounds.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "hiac/base/rounding.hpp"
#include "hiac/base/special_values.hpp"
#include "hiac/geometry/extended_vector.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/render/bounds/error_bound.hpp"
#include "hiac/render/refine/extended_light.hpp"
#include "tests/render/bounds/expect_same.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac {
namespace {

using test::expect_same;

constexpr double u = kUnit;

OpticsTables tables(const std::vector<PiecewiseLinear<1>::Point>& extinction,
                    const std::vector<PiecewiseLinear<3>::Point>& color,
                    const char* color_field = "f") {
  Volume volume;
  volume.extinction = ExtinctionTransfer{"f", extinction};
  volume.color = ColorTransfer{color_field, color};
  return make_optics_tables(volume, Integration::exact);
}

// Slope 4 from the anchor (1, 3), of which the cell has [1, 3]; colour of slopes 1, 2 and 6 there.
TEST(CellOptics, AreThoseOfTheValuesInTheCell) {
  const OpticsTables optics = tables({{0, {7}}, {1, {3}}, {4, {15}}, {5, {100}}},
                                     {{1, {0, 0, 0}}, {4, {3, 6, 18}}, {5, {0, 0, 99}}}, "g");
  const CellOptics cell = cell_optics(optics, {1.5, 3}, {1.5, 3});
  EXPECT_EQ(cell.tau_slope, 4);
  EXPECT_EQ(cell.color_slope, 6);
  EXPECT_EQ(cell.tau_jump, 0);
  EXPECT_EQ(cell.color_jump, 0);
  // 8 u of the anchor's value, and of the slope times how far the values are from it
  expect_same(cell.tau_rounding, 8 * u * (3 + 4 * 2));
  EXPECT_EQ(cell.tau_most, 11 + cell.tau_rounding);
  EXPECT_EQ(cell.color_most, 12 + cell.color_rounding);
  EXPECT_EQ(cell.pieces, 2);
  EXPECT_EQ(cell_optics(optics, {1.5, 3}, {0.5, 4.5}).pieces, 4);
}

// With two steps, of 2 and 5, and one that is at the end of the range.
TEST(CellOptics, AddUpTheJumpsInTheCell) {
  const OpticsTables optics =
      tables({{1, {1}}, {1, {3}}, {2, {3}}, {2, {8}}, {3, {8}}, {3, {9}}},
             {{1, {0, 0, 0}}, {1, {0.5, 0.25, 0}}, {2, {0.5, 0.25, 0}}}, "g");
  EXPECT_EQ(cell_optics(optics, {0, 4}, {0.5, 2.5}).tau_jump, 7);
  EXPECT_EQ(cell_optics(optics, {0, 4}, {2, 3}).tau_jump, 6);
  EXPECT_EQ(cell_optics(optics, {0, 4}, {1.5, 1.75}).tau_jump, 0);
  EXPECT_EQ(cell_optics(optics, {0, 4}, {0, 1}).color_jump, 0.5);
  EXPECT_EQ(jump_at(optics.extinction, 1, 0.9), 2);
  EXPECT_EQ(jump_at(optics.extinction, 1, 1), 0);  // no more than what both sides are rounded by
}

// The gradient times the displacement; 3 u of the largest value and 20 u of the range times the
// spread in tetrahedra, 64 u of the largest value along rays.
TEST(FieldError, AddsUpItsTerms) {
  const ValueRange range{-5, 3};
  EXPECT_EQ(field_error(range, 2, {.aside = 0.25}, {0, 0}), 0.5);
  EXPECT_EQ(field_error(range, 0, {.spread = 1}, kTetrahedronRounding), u * (3 * 5 + 20 * 8));
  EXPECT_EQ(field_error(range, 0, {.spread = 4}, kTetrahedronRounding), u * (3 * 5 + 20 * 4 * 8));
  EXPECT_EQ(field_error(range, 0, {.spread = 4}, kAlongRayRounding), u * 64 * 5);
  EXPECT_EQ(field_error({-3, 5}, 0, {}, {1, 0}), u * 5);
  EXPECT_EQ(field_error(range, 0, {.spread = 4}, kAlongRayRounding, kExtended),
            kExtendedUnit * 64 * 5);
  EXPECT_EQ(field_error(range, 33, {.aside = 0.25}, {0, 0}), 8);  // all of the range at most
}

TEST(Arithmetic, IsThatOfTheModel) {
  EXPECT_EQ(kDoubles.unit, u);
  EXPECT_EQ(kDoubles.snap, 0x1p-38);
  EXPECT_EQ(kDoubles.piece, 2e-14);
  EXPECT_EQ(kDoubles.function, 8 * u);
  if (!kExtendedIsFiner) GTEST_SKIP() << "long double is no finer than double";
  EXPECT_EQ(kExtended.unit, 0x1p-64);
  EXPECT_EQ(kExtended.snap, 0);
  EXPECT_EQ(kExtended.piece, 5e-17);
  EXPECT_EQ(kExtended.function, 1.01 * u);
}

constexpr Arithmetic kNoRounding{.unit = 0, .snap = 0, .piece = 0, .function = 0};

// What exact numbers leave: u for the transparency's own rounding.
TEST(SegmentBound, CountsTheRoundingOfEvaluation) {
  const SegmentFacts all{.length = 1, .seen = 1, .opacity = 1, .transparency = 1};
  expect_same(segment_bound({}, false, all, kNoRounding).transparency, u);
  EXPECT_EQ(segment_bound({}, false, all, kNoRounding).radiance, 0);
  // 8 u of the largest extinction, over the length
  const CellOptics dense{.tau_most = 1};
  expect_same(segment_bound(dense, false, all).transparency, 8 * u + u);
  expect_same(segment_bound(dense, false, {.length = 3, .transparency = 0.5}).transparency,
              0.5 * 3 * 8 * u + u);
  // 8 u of the largest colour, where all of it is seen
  const CellOptics bright{.color_most = 1};
  expect_same(segment_bound(bright, false, all).radiance, 8 * u);
  expect_same(segment_bound(bright, true, {.length = 3, .seen = 2}).radiance, 2 * 8 * u);
  expect_same(segment_bound(bright, true, {.length = 2, .seen = 3}).radiance, 2 * 8 * u);
  // 2e-14 for every piece
  const CellOptics pieces{.color_most = 1, .pieces = 3};
  expect_same(segment_bound(pieces, false, all).transparency, 3 * 2e-14 + u);
  expect_same(segment_bound(pieces, false, all).radiance, 3 * 2e-14 + 8 * u);
  expect_same(segment_bound(pieces, true, all).radiance, 3 * 2e-14 + 8 * u);
}

TEST(SegmentBound, CountsTheErrorsOfFunctions) {
  const SegmentFacts facts{.length = 1,
                           .seen = 1,
                           .color = {.error = 1e-6},
                           .extinction = {.error = 1e-5},
                           .opacity = 1,
                           .transparency = 1};
  const double growth = 2e-5 + 4e-10;  // not less than e^x - 1
  expect_same(segment_bound({.tau_slope = 2}, false, facts, kNoRounding).transparency, growth + u);
  expect_same(segment_bound({.tau_rounding = 2e-5}, false, facts, kNoRounding).transparency,
              growth + u);
  expect_same(segment_bound({.color_slope = 3}, false, facts, kNoRounding).radiance, 0);
  const CellOptics sloped{.color_most = 1, .color_slope = 3, .color_rounding = 1e-7};
  expect_same(segment_bound(sloped, false, facts, kNoRounding).radiance, 3e-6 + 1e-7);
  expect_same(segment_bound(sloped, true, facts, kNoRounding).radiance, 3e-6 + 1e-7);
}

// Extinction 0.01 and colour 1 over a length of 2: extinction wrong by d changes 1 - e^(-tau L) by
// L e^(-tau L) d, and the transparency as much.
TEST(SegmentBound, IsNearWhatWrongExtinctionDoes) {
  constexpr double kTau = 0.01, kLength = 2, kOff = 1e-6;
  const CellOptics cell{.tau_most = kTau, .tau_slope = 1, .color_most = 1};
  const double opacity = -std::expm1(-kTau * kLength), seen = opacity / kTau;
  const ErrorBound bound = segment_bound(cell, false,
                                         {.length = kLength,
                                          .seen = seen,
                                          .extinction = {.error = kOff},
                                          .opacity = opacity,
                                          .transparency = 1 - opacity});
  const double error = -std::exp(-kTau * kLength) * std::expm1(-kOff * kLength);
  for (const double claimed : {bound.radiance, bound.transparency}) {
    EXPECT_GE(claimed, error);
    EXPECT_LE(claimed, 1.1 * error);
  }
  // the same as emission: of length times colour, L^2 / 2 d at most
  const ErrorBound emitted = segment_bound(cell, true,
                                           {.length = kLength,
                                            .seen = seen,
                                            .extinction = {.error = kOff},
                                            .transparency = 1 - opacity});
  EXPECT_GE(emitted.radiance, kLength * kLength / 2 * kOff * 0.97);
  EXPECT_LE(emitted.radiance, kLength * kLength * kOff * 1.01);
}

// Where little is seen of a long segment what is behind its front counts as little.
TEST(SegmentBound, WeighsErrorsWithWhatIsSeen) {
  SegmentFacts facts{.length = 1, .seen = 0.1, .extinction = {.error = 1e-3}, .opacity = 0.5};
  const CellOptics cell{.tau_slope = 1, .color_most = 1};
  const double growth = 1e-3 + 1e-6;
  expect_same(segment_bound(cell, true, facts, kNoRounding).radiance, 0.1 * growth);
  const double seen = (1 + growth) * 0.1 * 1e-3;  // int |tau' - tau| e^-A, and the same behind it
  expect_same(segment_bound(cell, false, facts, kNoRounding).radiance, 2 * seen);
  facts.extinction.jumped = 1e-4;
  const double both = 1.1e-3 + 1.1e-3 * 1.1e-3, weight = 0.5 + 1.1e-3;
  const double with_jump = (1 + both) * 0.1 * 1e-3;
  expect_same(segment_bound(cell, false, facts, kNoRounding).radiance,
              1e-4 + with_jump + weight * (1e-4 + 1e-8) + with_jump);
}

// A colour in doubt on `jumped`: all of it is wrong, times the extinction there.
TEST(SegmentBound, CountsJumpsWithWhatTheyShow) {
  const CellOptics cell{.tau_most = 0.25, .color_most = 2};
  const SegmentFacts color{.length = 1, .seen = 1, .color = {.jumped = 1e-3}, .opacity = 0.2};
  expect_same(segment_bound(cell, false, color, kNoRounding).radiance, 0.25e-3);
  expect_same(segment_bound(cell, true, color, kNoRounding).radiance, 1e-3);
  // depth in doubt by 1e-3, with weight 0.2 + 1e-3 in front and all of it at most behind
  const SegmentFacts depth{.length = 1, .seen = 1, .extinction = {.jumped = 1e-3}, .opacity = 0.2};
  expect_same(segment_bound(cell, false, depth, kNoRounding).radiance,
              2 * (1e-3 + 0.201 * (1e-3 + 1e-6)));
}

// Bounds of order 1 say that anything may be.
TEST(SegmentBound, IsNoMoreThanAnythingCanBe) {
  const CellOptics cell{.tau_most = 1, .tau_slope = 1, .color_most = 0.75};
  const SegmentFacts doubtful{
      .length = 1, .seen = 1, .extinction = {.error = 0.6}, .opacity = 1, .transparency = 0.5};
  EXPECT_EQ(segment_bound(cell, false, doubtful).transparency, 1);
  EXPECT_EQ(segment_bound(cell, false, doubtful).radiance, 1.001 * 0.75);
}

TEST(EdgeBound, IsWhatTheLengthHolds) {
  const CellOptics cell{.tau_most = 0.5, .color_most = 3};
  expect_same(edge_bound(cell, false, 0.01), 3 * 0.5 * 0.01);
  expect_same(edge_bound(cell, true, 0.01), 3 * 0.01);
  expect_same(edge_bound({.tau_most = 0.5, .color_most = 0.25}, false, 0.01), 0.5 * 0.01);
  expect_same(edge_bound(cell, false, kInfinity), 3);
}

// Offsets from -1 to 3, wrong by 1e-4: a band of 2e-4 of the change, and both ends' places.
TEST(CutBound, IsWhatTheSurfaceMovesThrough) {
  const CutFacts cut{.length = 2,
                     .along = 1e-3,
                     .front = -1,
                     .back = 3,
                     .front_error = 1e-4,
                     .back_error = 5e-5,
                     .crossed = true};
  expect_same(cut_doubt(cut), 2 * 2e-4 / 4 + 2e-3);
  CutFacts known = cut;
  known.along = 0;
  const double moved = 1e-4;
  expect_same(cut_doubt(known), moved);
  std::swap(known.front_error, known.back_error);
  expect_same(cut_doubt(known), moved);
  std::swap(known.front_error, known.back_error);
  const CellOptics cell{.tau_most = 0.5, .color_most = 3};
  const ErrorBound shade{1e-3, 2e-3};
  const ErrorBound bound = cut_bound(cell, false, 7, known, shade);
  expect_same(bound.radiance, 1e-3 + 3 * moved * 0.5 + 0.5 * moved * 7);
  EXPECT_EQ(bound.transparency, 2e-3);
  expect_same(cut_bound(cell, true, 7, known, shade).radiance, 1e-3 + 3 * moved + 0.5 * moved * 7);
  known.crossed = false;
  EXPECT_EQ(cut_bound(cell, false, 7, known, shade).radiance, 0);
  // in doubt: all that may be there or not
  for (const bool at_front : {true, false}) {
    CutFacts doubtful = cut;
    (at_front ? doubtful.front : doubtful.back) = 0.9 * (at_front ? 1e-4 : 5e-5);
    const ErrorBound whole = cut_bound(cell, true, 7, doubtful, shade);
    EXPECT_EQ(whole.radiance, 7 + 3 * 2);
    EXPECT_EQ(whole.transparency, 1);
    EXPECT_EQ(cut_bound(cell, false, 7, doubtful, shade).radiance, 7 + 3);
    (at_front ? doubtful.front : doubtful.back) = 1.1 * (at_front ? 1e-4 : 5e-5);
    EXPECT_LT(cut_bound(cell, true, 7, doubtful, shade).radiance, 1);
  }
}

class ShadeBoundTest : public testing::Test {
 protected:
  static constexpr FrameIsosurface kOpaque{{{0.5, 0.25, 0.125}, -kInfinity, 0, 1, 0, 1}, 0, 0};
  std::vector<FrameLight> lights_{{true, {}, {1, 1, 1}}};
  static constexpr std::array<double, 3> kTowards{0, 0, -1}, kRay{0, 0, 1};
};

// 16 u more of angle than is said; twice the angle in diffuse light, 32 u of all light, 8 u of the
// transparency.
TEST_F(ShadeBoundTest, CountsTheRoundingOfEvaluation) {
  const ErrorBound diffuse = shade_bound(kOpaque, lights_, kTowards, kRay, 0);
  expect_same(diffuse.transparency, 8 * u);
  expect_same(diffuse.radiance, 0.5 * (2 * 16 + 32 + 8) * u);
  FrameIsosurface ambient = kOpaque;
  ambient.diffuse = 0;
  ambient.ambient = 1;
  expect_same(shade_bound(ambient, lights_, kTowards, kRay, 0).radiance, 0.5 * (32 + 8) * u);
  lights_[0].color = {0.125, 0.25, 3};
  expect_same(shade_bound(kOpaque, lights_, kTowards, kRay, 0).radiance,
              3 * 0.5 * (2 * 16 + 32 + 8) * u);
  // an angle that is known to be wrong counts besides
  lights_[0].color = {1, 1, 1};
  expect_same(shade_bound(kOpaque, lights_, kTowards, kRay, 1e-3).radiance,
              0.5 * (2e-3 + (2 * 16 + 32 + 8) * u));
}

// A cosine of R.V is off by six times the angle at most, and begins at once.
TEST_F(ShadeBoundTest, CountsWhatHighlightsChangeBy) {
  FrameIsosurface shining{{{1, 1, 1}, -kInfinity, 0, 0, 1, 1}, 0, 0};
  const auto highlight = [&](double shininess, const std::array<double, 3>& normal, double angle) {
    shining.shininess = shininess;
    return shade_bound(shining, lights_, normal, kRay, angle).radiance;
  };
  const double facing = 0.8, cosine = 2 * facing * facing - 1, angle = 1e-4;
  const std::array<double, 3> tilted{0.6, 0, -facing};
  const double e = 6 * angle;
  const auto expect_near = [](double value, double expected) {
    EXPECT_NEAR(value, expected, 1e-6 * expected);
  };
  expect_near(highlight(1, tilted, angle), e);
  expect_near(highlight(2, tilted, angle), 2 * (cosine + e) * e);
  expect_near(highlight(10, tilted, angle), 10 * std::pow(cosine + e, 9) * e);
  expect_near(highlight(10, kTowards, angle), 10 * e);
  expect_near(highlight(0.5, tilted, angle), 0.5 * std::pow(cosine - e, -0.5) * e);
  // where it begins, c^s is as steep as can be for s < 1
  const double c = 1.5 * e, edge = std::sqrt((1 + c) / 2);
  expect_near(highlight(0.5, {std::sqrt(1 - edge * edge), 0, -edge}, angle), std::sqrt(c + e));
  // a highlight is in doubt by the whole of it at most
  expect_near(highlight(100, kTowards, 1e-2), 1);
  // turned away by more than the error: none
  EXPECT_LT(highlight(0.5, {0.8, 0, -0.6}, angle), 1e-14);
  // light that grazes: whether there is a highlight is in doubt
  lights_[0] = {false, {1, 0, 0}, {1, 1, 1}};
  expect_near(highlight(10, {1.9 * angle, 0, -1}, angle), 1);
  EXPECT_LT(highlight(10, {2.5 * angle, 0, -1}, angle), 0.9);
}

// Where rounding hides from which side the surface is seen, all that lights shine on it is in
// doubt, but for what comes from the eye.
TEST_F(ShadeBoundTest, DoubtsTheSideOfSurfacesSeenEdgeOn) {
  FrameIsosurface shining = kOpaque;
  shining.specular = 0.25;
  lights_[0] = {false, {1, 0, 0}, {1, 1, 1}};
  const double angle = 1e-4;
  const auto bound_at = [&](double facing) {
    return shade_bound(shining, lights_, {std::sqrt(1 - facing * facing), 0, -facing}, kRay, angle)
        .radiance;
  };
  EXPECT_NEAR(bound_at(0.9 * angle), 0.5 + 0.25, 1e-12);
  EXPECT_LT(bound_at(1.1 * angle), 0.01);
  lights_[0].headlight = true;
  EXPECT_LT(bound_at(0.9 * angle), 0.3);
}

// T = (1 - opacity)^(1 / cosine), between the cosines that may be.
TEST_F(ShadeBoundTest, CountsWhatTransparencyChangesBy) {
  const FrameIsosurface clear{{{1, 1, 1}, -0.7, 0.5, 0, 0, 1}, 0, 0};
  const double facing = 0.6, angle = 1e-3;
  const auto at = [](double cosine) { return std::exp(-0.7 / cosine); };
  const double most = std::max(at(facing + angle) - at(facing), at(facing) - at(facing - angle));
  const ErrorBound bound = shade_bound(clear, lights_, {0.8, 0, -facing}, kRay, angle);
  EXPECT_NEAR(bound.transparency, most + 8 * u, 1e-10 * most);
  EXPECT_NEAR(bound.radiance, (1 - at(facing)) * 32 * u * 0.5 + 0.5 * bound.transparency,
              1e-12 * most);
}

// Light's error shows as much as the surface hides.
TEST_F(ShadeBoundTest, CountsLightAsOpaqueAsTheSurfaceIs) {
  FrameIsosurface clear = kOpaque;
  clear.log_transparency = std::log(0.75);
  const double angle = 1e-3, here = 0.75;
  const ErrorBound bound = shade_bound(clear, lights_, kTowards, kRay, angle);
  EXPECT_NEAR(bound.transparency, here - std::pow(0.75, 1 / (1 - angle)), 1e-12);
  EXPECT_NEAR(bound.radiance, (1 - here) * 0.5 * 2 * angle + 0.5 * bound.transparency, 1e-12);
}

// Normals turned by as much as they may be, any way: the shade is wrong by no more, and nearly by
// so much somewhere.
TEST_F(ShadeBoundTest, HoldsWhatTurnedNormalsDo) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto direction = [&] {
    return unit(ExtendedVector{any(random), any(random), any(random)});
  };
  double closest = 0, closest_highlight = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const double angle = std::pow(10, -1.5 + 2.5 * (any(random) - 1) / 2);
    FrameIsosurface surface{{{0.9, 0.5, 0.2}, -kInfinity, 0.2, 0.7, 0.5, 1}, 0, 0};
    const bool highlight = trial % 2 == 0;
    if (highlight) surface.diffuse = surface.ambient = 0;
    surface.shininess = trial % 3 == 0 ? 0.5 + 0.4 * any(random) : 1 + 30 * std::abs(any(random));
    if (trial % 5 == 0) surface.log_transparency = std::log(0.5 + 0.49 * any(random));
    const ExtendedVector ray = direction(), normal = direction(), aside = direction();
    lights_ = {{trial % 4 == 0, rounded(direction()), {0.8, 1, 0.3}}};
    // along the great circle towards `aside`
    const long double along = dot(aside, normal), by = angle;
    ExtendedVector across;
    for (std::size_t c = 0; c < 3; ++c) across[c] = aside[c] - along * normal[c];
    across = unit(across);
    ExtendedVector turned;
    for (std::size_t c = 0; c < 3; ++c)
      turned[c] = std::cos(by) * normal[c] + std::sin(by) * across[c];
    const ExtendedLight here = extended_surface(surface, lights_, normal, ray);
    const ExtendedLight there = extended_surface(surface, lights_, turned, ray);
    const ErrorBound bound = shade_bound(surface, lights_, rounded(normal), rounded(ray), angle);
    double error = 0;
    for (std::size_t c = 0; c < 3; ++c)
      error = std::max(error, static_cast<double>(std::abs(here.rgb[c] - there.rgb[c])));
    ASSERT_LE(error, bound.radiance * (1 + 1e-12))
        << trial << " facing " << static_cast<double>(dot(normal, ray)) << " angle " << angle;
    ASSERT_LE(std::abs(here.transparency - there.transparency), bound.transparency) << trial;
    (highlight ? closest_highlight : closest) =
        std::max(highlight ? closest_highlight : closest, error / bound.radiance);
  }
  EXPECT_GT(closest, 0.45);
  EXPECT_GT(closest_highlight, 0.6);
}

// A segment behind transparency 0.5 that is known to 1e-3.
TEST(PixelDetails, AddUpErrorsThroughWhatIsInFront) {
  PixelDetails pixel;
  pixel.transparency_error = 1e-3;
  pixel.last = 1;
  SegmentDetails segment{.front = 1, .back = 2, .light = 0.25, .transparency = 0.75};
  segment.radiance_error = 1e-4;
  segment.transparency_error = 1e-5;
  segment.front_edge = 0.1;  // adjoins: does not count
  segment.back_edge = 1e-6;
  pixel.add(segment, 0.5, 0);
  const double visible = 0.5 + 1e-3;
  expect_same(pixel.radiance_error, visible * 1e-4 + 1e-3 * 0.25 + 4 * u * 0.5 * 0.25);
  expect_same(pixel.transparency_error, 1e-3 * 0.75 + visible * 1e-5 + 2 * u * 0.5);
  expect_same(pixel.open_edge, visible * 1e-6);
  // the next one comes after a gap: both its front and the open back count, in light and depth
  const PixelDetails before = pixel;
  pixel.add({.front = 3, .back = 4, .front_edge = 1e-7}, 0.25, 0);
  const double edges = before.open_edge + (0.25 + before.transparency_error) * 1e-7;
  expect_same(pixel.radiance_error, before.radiance_error + edges);
  expect_same(pixel.transparency_error, before.transparency_error + edges + 2 * u * 0.25);
}

// Rounding alone: 4 u of the light so far and of what is added, 2 u of what is seen.
TEST(PixelDetails, CountTheRoundingOfCompositing) {
  PixelDetails pixel;
  pixel.last = 0;
  pixel.add({.front = 0, .back = 1, .light = 0.5}, 0.25, 3);
  expect_same(pixel.radiance_error, 4 * u * (3 + 0.25 * 0.5));
  expect_same(pixel.transparency_error, 2 * u * 0.25);
}

// In a frame whose brightest light is 2.
class PixelErrorTest : public testing::Test {
 protected:
  PixelErrorTest() : mesh_(test::structured(1, test::Cut::bricks)) {
    test::add_node_field(mesh_, "f", [](const test::Position& p) { return p[0]; });
    Scene scene = test::cube_scene(Projection::orthographic, 4, 4);
    test::make_uniform(scene);
    scene.volume.color->points = {{0, {0.5, 2, 1}}};
    projector_.emplace(scene.camera, scene.image);
    frame_.emplace(mesh_, scene, *projector_);
  }

  [[nodiscard]] double error(double transparency, bool ended, double background) const {
    return pixel_error(*frame_, pixel_, transparency, ended, background);
  }

  ZooMesh mesh_;
  std::optional<Projector> projector_;
  std::optional<Frame> frame_;
  PixelDetails pixel_;
};

TEST_F(PixelErrorTest, CountsTheRoundingOfTheBackground) {
  expect_same(error(0.5, false, 0), 4 * u);
  expect_same(error(0.5, false, 3), 4 * u * 4);
}

// What is left of an ended ray's transparency, times the most that may be behind or show instead.
TEST_F(PixelErrorTest, CountsWhatIsBehindTheEnd) {
  EXPECT_NEAR(error(1e-5, true, 0.5), 2e-5, 1e-12);
  EXPECT_NEAR(error(1e-5, true, 3), 3e-5, 1e-12);
  pixel_.transparency_error = 1e-6;  // there may be more left than it seems
  EXPECT_NEAR(error(1e-5, true, 0.5), 2e-5 + 2e-6 + 0.5e-6, 1e-12);
  EXPECT_NEAR(error(1e-5, false, 0.5), 1e-6, 1e-12);
  pixel_.transparency_error = 0;
  frame_->largest_light = 0.5;  // of A: all of what is left
  EXPECT_NEAR(error(1e-5, true, 0.25), 1e-5, 1e-12);
}

TEST_F(PixelErrorTest, CountsErrorsOfLightAndTransparency) {
  pixel_.radiance_error = 1e-3;
  pixel_.transparency_error = 1e-4;
  pixel_.open_edge = 1e-5;
  EXPECT_NEAR(error(0.5, false, 0), 1e-3 + 1e-5, 1e-12);
  EXPECT_NEAR(error(0.5, false, 2), 1e-3 + 1e-5 + 2 * (1e-4 + 1e-5), 1e-12);
  pixel_.radiance_error = 0;
  EXPECT_NEAR(error(0.5, false, 0), 1e-4 + 1e-5, 1e-12);
}

}  // namespace
}  // namespace hiac
