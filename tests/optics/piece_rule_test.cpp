#include "hiac/optics/piece_rule.hpp"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace hiac {
namespace {

const PiecewiseLinear<3> kColor(std::vector<PiecewiseLinear<3>::Point>{
    {0.2, {0.1, 0.9, 0.3}}, {0.5, {0.8, 0.2, 0.3}}, {0.9, {0.4, 0.6, 1}}});
const PiecewiseLinear<1> kExtinction(std::vector<PiecewiseLinear<1>::Point>{
    {0.1, {0.5}}, {0.4, {3}}, {0.4, {1}}, {0.8, {2}}});

TEST(PieceRule, MeanColorHasTheExactOpacity) {
  for (const double b : {0.0, 1e-9, 0.3, 5.0, 80.0})
    for (const double a : {0.0, 2e-7, 0.9, 30.0}) {
      const LinearPieceWeights w =
          linear_piece_by_rule(PieceRule::mean_color, Glow::chromaticity, b, a);
      EXPECT_EQ(w.front, w.back);
      EXPECT_NEAR(w.front + w.back, -std::expm1(-0.5 * (a + b)), 1e-15);
      EXPECT_NEAR(w.transparency, std::exp(-0.5 * (a + b)), 1e-15);
    }
}

TEST(PieceRule, FivePointsConvergeToTheExactWeights) {
  for (const Glow glow : {Glow::chromaticity, Glow::emission})
    for (const double b : {0.0, 0.1, 0.4})
      for (const double a : {0.0, 0.2, 0.5}) {
        const LinearPieceWeights w = linear_piece_by_rule(PieceRule::five_points, glow, b, a);
        const LinearPieceWeights exact = linear_piece_by_rule(PieceRule::exact, glow, b, a);
        EXPECT_NEAR(w.front, exact.front, 1e-10);
        EXPECT_NEAR(w.back, exact.back, 1e-10);
        EXPECT_NEAR(w.transparency, exact.transparency, 1e-15);
      }
}

// Quadratic fields on short segments, where five points are as good as exact.
TEST(PieceRule, SegmentsAgreeWithTheExactOnesWhenTheyAreThin) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 50; ++trial)
    for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
      std::array<double, 3> color, extinction;
      for (double& c : color) c = unit(random);
      for (double& c : extinction) c = unit(random);
      const PolynomialSegment segment{BernsteinPolynomial(color), BernsteinPolynomial(extinction),
                                      0.05};
      const SegmentRadiance exact = integrate_segment(segment, kColor, kExtinction, glow, 1e-15);
      const PlainRadiance gauss =
          integrate_segment_by_rule(PieceRule::five_points, segment, kColor, kExtinction, glow);
      EXPECT_NEAR(gauss.transparency, exact.transparency, 1e-13);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(gauss.rgb[c], exact.rgb[c], 1e-9);
    }
}

// A linear field: the pieces between its cuts, one after another.
TEST(PieceRule, LinearSegmentsAreTheirPieces) {
  const std::array<double, 2> field{0, 1};
  const PolynomialSegment segment{BernsteinPolynomial(field), BernsteinPolynomial(field), 1.7};
  for (const PieceRule rule : {PieceRule::mean_color, PieceRule::five_points})
    for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
      PlainRadiance expected;
      const std::array cuts{0.0, 0.1, 0.2, 0.4, 0.5, 0.8, 0.9, 1.0};
      for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const double s = cuts[i], t = cuts[i + 1], middle = 0.5 * (s + t);
        const auto& color = kColor.piece(kColor.interval_of(middle));
        const auto& tau = kExtinction.piece(kExtinction.interval_of(middle));
        expected.add_behind(integrate_unsliced(
            rule, (t - s) * 1.7, {color.channel(0, s), color.channel(1, s), color.channel(2, s)},
            {color.channel(0, t), color.channel(1, t), color.channel(2, t)}, tau.channel(0, s),
            tau.channel(0, t), glow));
      }
      const PlainRadiance sum = integrate_segment_by_rule(rule, segment, kColor, kExtinction, glow);
      EXPECT_NEAR(sum.transparency, expected.transparency, 1e-15);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sum.rgb[c], expected.rgb[c], 1e-14);
    }
}

TEST(PieceRule, TheExactIntegralOfASegmentIsElsewhere) {
  const std::array<double, 1> field{0.5};
  const PolynomialSegment segment{BernsteinPolynomial(field), BernsteinPolynomial(field), 1};
  EXPECT_THROW(
      integrate_segment_by_rule(PieceRule::exact, segment, kColor, kExtinction, Glow::chromaticity),
      std::invalid_argument);
}

}  // namespace
}  // namespace hiac
