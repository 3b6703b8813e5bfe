#pragma once

#include <array>
#include <cstdint>

#include "hiac/base/transfer_function.hpp"
#include "hiac/optics/linear_piece.hpp"
#include "hiac/optics/polynomial_piece.hpp"

namespace hiac {

/// Rules for the radiance of a piece of a ray on which the transfer functions are linear (Williams,
/// Max, Stein 1998, sections 4 and 5.2). The errors of the last two rules have no bound.
enum class PieceRule : std::uint8_t {
  exact,
  /// The colour is constant, the mean of its values at the two ends; the extinction is linear.
  mean_color,
  /// The five-point Gauss-Legendre rule for the integral of (11), and that of Wilhelms and Van
  /// Gelder; the optical depth in front of each point is integrated with five points as well
  /// (exactly, up to degree 9).
  five_points
};

/// Returns the weights of linear_piece_weights (chromaticity) or linear_piece_emission, by a rule.
LinearPieceWeights linear_piece_by_rule(PieceRule rule, Glow glow, double b, double a);

/// The effect of a segment on the light, without error bounds.
struct PlainRadiance {
  std::array<double, 3> rgb{};  ///< radiance that leaves the front with nothing behind
  double transparency = 1;

  void add_behind(const PlainRadiance& other) {
    for (std::size_t c = 0; c < 3; ++c) rgb[c] += transparency * other.rgb[c];
    transparency *= other.transparency;
  }
};

/// Integrates a segment along which the fields are polynomials by a rule other than `exact`. The
/// segment is cut wherever a field takes a value at which its transfer function bends or jumps; the
/// rule applies to each piece. Throws std::invalid_argument for `exact`.
PlainRadiance integrate_segment_by_rule(PieceRule rule, const PolynomialSegment& segment,
                                        const PiecewiseLinear<3>& color,
                                        const PiecewiseLinear<1>& extinction, Glow glow);

/// Integrates a segment without cuts by the rule: colour and extinction are linear between their
/// values at the two ends, whatever lies between (section 8, Fig. 10).
PlainRadiance integrate_unsliced(PieceRule rule, double length, const std::array<double, 3>& front,
                                 const std::array<double, 3>& back, double tau_front,
                                 double tau_back, Glow glow);

}  // namespace hiac
