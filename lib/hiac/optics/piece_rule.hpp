#pragma once

#include <array>
#include <cstdint>

#include "hiac/base/glow.hpp"
#include "hiac/base/piecewise_linear.hpp"
#include "hiac/optics/linear_piece.hpp"
#include "hiac/optics/polynomial_piece.hpp"

namespace hiac {

/// Rules for the radiance of a piece of a ray on which the transfer functions do not bend
/// (Williams, Max, Stein 1998, sections 4 and 5.2). The errors of the last two rules are not
/// bounded.
enum class PieceRule : std::uint8_t {
  exact,
  /// The colour is constant, the mean of its values at the two ends; the extinction is linear.
  mean_color,
  /// The Gauss-Legendre rule with five points on the integral of (11), and of Wilhelms and Van
  /// Gelder's; the optical depth in front of each point is integrated by five points as well
  /// (exactly, up to degree 9).
  five_points
};

/// The weights of linear_piece_weights (chromaticity) and linear_piece_emission, by a rule.
LinearPieceWeights linear_piece_by_rule(PieceRule rule, Glow glow, double b, double a);

/// The effect of a segment on the light, without error bounds.
struct PlainRadiance {
  std::array<double, 3> rgb{};  ///< radiance leaving the front, nothing behind
  double transparency = 1;

  void add_behind(const PlainRadiance& other) {
    for (std::size_t c = 0; c < 3; ++c) rgb[c] += transparency * other.rgb[c];
    transparency *= other.transparency;
  }
};

/// A segment along which the fields are polynomials by a rule other than `exact`: cut wherever a
/// field takes a value at which its transfer function bends or jumps, each piece by the rule.
/// Throws std::invalid_argument for `exact`.
PlainRadiance integrate_segment_by_rule(PieceRule rule, const PolynomialSegment& segment,
                                        const PiecewiseLinear<3>& color,
                                        const PiecewiseLinear<1>& extinction, Glow glow);

/// A segment without cuts: colour and extinction as if linear between their values at the two ends,
/// whatever lies between (section 8, Fig. 10), by the rule.
PlainRadiance integrate_unsliced(PieceRule rule, double length, const std::array<double, 3>& front,
                                 const std::array<double, 3>& back, double tau_front,
                                 double tau_back, Glow glow);

}  // namespace hiac
