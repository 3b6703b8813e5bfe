#include "hiac/preview/methods/effective_color.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/optics/linear_piece.hpp"

namespace hiac::preview {
namespace {

// Opacities below which the effective colour is its limit: its error is of that order.
constexpr double kTinyOpacity = 1e-6;
// With emission: relative difference of the ends' densities below which that of two lookups, each
// exact to 1e-8, says nothing.
constexpr double kLeastDifference = 1e-5;

// Psi = int_0^1 exp(-A), A = b u + (a - b) u^2 / 2, by completing the square; false where an
// argument is beyond the tables.
bool psi_by_tables(const GaussianTables& tables, double b, double a, double& psi) {
  const double delta = a - b;
  if (delta == 0) {
    psi = opacity_ratio(b);
    return true;
  }
  const double root = std::sqrt(2 * std::abs(delta));
  const double p = b / root, q = a / root;
  if (!(p <= GaussianTables::kRange && q <= GaussianTables::kRange)) return false;
  psi = 2 / root *
        (delta > 0 ? std::exp(p * p) * (tables.falling(q) - tables.falling(p))
                   : std::exp(-p * p) * (tables.growing(p) - tables.growing(q)));
  return true;
}

}  // namespace

double opacity_ratio(double x) { return x < 1e-8 ? 1 - x / 2 : -std::expm1(-x) / x; }

// Weights of the two ends' colours; with chromaticity they add up to 1. b, a: densities at the
// front and the back times the length.
EffectiveColor::Weights EffectiveColor::weights(double b, double a, bool& reverted) const {
  reverted = false;
  if (method_ == Method::interpolated_opacity || method_ == Method::mean_color) return {0.5, 0.5};
  const double opacity = -std::expm1(-(a + b) / 2);
  if (opacity < kTinyOpacity) {
    if (glow_ == Glow::emission || a + b == 0) return {0.5, 0.5};
    return {(2 * b + a) / (3 * (a + b)), (b + 2 * a) / (3 * (a + b))};
  }
  if (method_ == Method::tables) return by_tables(b, a, reverted);
  const LinearPieceWeights exact =
      glow_ == Glow::emission ? linear_piece_emission(b, a) : linear_piece_weights(b, a);
  const double sum = glow_ == Glow::emission ? opacity_ratio((a + b) / 2) : opacity;
  return {exact.front / sum, exact.back / sum};
}

EffectiveColor::Weights EffectiveColor::by_tables(double b, double a, bool& reverted) const {
  const double opacity = -std::expm1(-(a + b) / 2);
  double psi = 0;
  if (!psi_by_tables(tables_, b, a, psi)) {
    reverted = true;
    return {0.5, 0.5};
  }
  if (glow_ == Glow::chromaticity) {
    const double front = std::clamp((1 - psi) / opacity, 0.0, 1.0);
    return {front, 1 - front};
  }
  const double ratio = opacity_ratio((a + b) / 2);
  double psi1;
  if (a == b) {
    // int u exp(-b u)
    psi1 = (psi - std::exp(-b)) / b;
  } else {
    if (std::abs(a - b) < kLeastDifference * std::max(1.0, std::max(a, b))) {
      reverted = true;
      return {0.5, 0.5};
    }
    psi1 = (opacity - b * psi) / (a - b);
  }
  return {(psi - psi1) / ratio, psi1 / ratio};
}

std::array<double, 3> EffectiveColor::at(double length, const RayEnd& front, const RayEnd& back,
                                         bool& reverted) const {
  // at no length the limit depends on the ratio of the densities alone
  const double scale = length > 0 ? length : kTinyOpacity / (1 + front.tau + back.tau) / 2;
  const Weights w = weights(front.tau * scale, back.tau * scale, reverted);
  std::array<double, 3> color;
  for (std::size_t c = 0; c < 3; ++c) color[c] = w.front * front.color[c] + w.back * back.color[c];
  return color;
}

}  // namespace hiac::preview
