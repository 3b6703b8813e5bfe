#include "hiac/optics/piece_rule.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "hiac/base/gauss_legendre.hpp"
#include "hiac/optics/polynomial_roots.hpp"

namespace hiac {
namespace {

constexpr std::size_t kPoints = 5;

// Calls f(u, weight) for the points and weights of the five-point rule on [0, 1].
template <typename Function>
void at_points(const Function& f) {
  const GaussRule rule = gauss_legendre(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) f(0.5 * (1 + rule.nodes[i]), 0.5 * rule.weights[i]);
}

LinearPieceWeights by_five_points(Glow glow, double b, double a) {
  LinearPieceWeights w{std::exp(-0.5 * (a + b)), 0, 0};
  at_points([&](double u, double weight) {
    weight *= std::exp(-u * (b + 0.5 * (a - b) * u));
    if (glow == Glow::chromaticity) weight *= b + (a - b) * u;
    w.front += weight * (1 - u);
    w.back += weight * u;
  });
  return w;
}

// Optics on a piece [t0, t1] of a segment between two cuts.
class CutPiece {
 public:
  CutPiece(const PolynomialSegment& segment, const PiecewiseLinear<3>& color,
           const PiecewiseLinear<1>& extinction, double t0, double t1)
      : segment_(segment),
        color_(color.piece(color.interval_of(evaluate(segment.color_field, 0.5 * (t0 + t1))))),
        extinction_(extinction.piece(
            extinction.interval_of(evaluate(segment.extinction_field, 0.5 * (t0 + t1))))),
        t0_(t0),
        t1_(t1) {}

  [[nodiscard]] PlainRadiance mean_color(Glow glow) const {
    return integrate_unsliced(PieceRule::mean_color, length(), color(0), color(1), tau(0), tau(1),
                              glow);
  }

  [[nodiscard]] PlainRadiance five_points(Glow glow) const {
    PlainRadiance result;
    at_points([&](double u, double weight) {
      weight *= length() * std::exp(-depth(u));
      if (glow == Glow::chromaticity) weight *= tau(u);
      const auto at = color(u);
      for (std::size_t c = 0; c < 3; ++c) result.rgb[c] += weight * at[c];
    });
    result.transparency = std::exp(-depth(1));
    return result;
  }

 private:
  [[nodiscard]] double length() const { return (t1_ - t0_) * segment_.length; }
  [[nodiscard]] double place(double u) const { return t0_ + u * (t1_ - t0_); }
  [[nodiscard]] std::array<double, 3> color(double u) const {
    const double s = evaluate(segment_.color_field, place(u));
    return {color_.channel(0, s), color_.channel(1, s), color_.channel(2, s)};
  }
  [[nodiscard]] double tau(double u) const {
    return std::max(0.0, extinction_.channel(0, evaluate(segment_.extinction_field, place(u))));
  }
  [[nodiscard]] double depth(double u) const {
    double sum = 0;
    at_points([&](double v, double weight) { sum += weight * tau(u * v); });
    return u * length() * sum;
  }

  const PolynomialSegment& segment_;
  const PiecewiseLinear<3>::Piece& color_;
  const PiecewiseLinear<1>::Piece& extinction_;
  double t0_, t1_;
};

template <std::size_t N>
void add_cuts(const BernsteinPolynomial& field, const PiecewiseLinear<N>& function,
              std::vector<double>& places) {
  const auto [least, most] = std::ranges::minmax(field.coefficients());
  const auto breakpoints = function.breakpoints();
  std::vector<RootEnclosure> roots;
  for (auto s = std::ranges::lower_bound(breakpoints, least); s != breakpoints.end() && *s <= most;
       ++s)
    append_roots(field, *s, roots);
  for (const RootEnclosure& root : roots) places.push_back(0.5 * (root.low + root.high));
}

}  // namespace

LinearPieceWeights linear_piece_by_rule(PieceRule rule, Glow glow, double b, double a) {
  if (rule == PieceRule::five_points) return by_five_points(glow, b, a);
  LinearPieceWeights w =
      glow == Glow::emission ? linear_piece_emission(b, a) : linear_piece_weights(b, a);
  if (rule == PieceRule::mean_color) w.front = w.back = 0.5 * (w.front + w.back);
  return w;
}

PlainRadiance integrate_unsliced(PieceRule rule, double length, const std::array<double, 3>& front,
                                 const std::array<double, 3>& back, double tau_front,
                                 double tau_back, Glow glow) {
  const LinearPieceWeights w =
      linear_piece_by_rule(rule, glow, tau_front * length, tau_back * length);
  const double unit = glow == Glow::emission ? length : 1;
  PlainRadiance result{{}, w.transparency};
  for (std::size_t c = 0; c < 3; ++c)
    result.rgb[c] = unit * (w.front * front[c] + w.back * back[c]);
  return result;
}

PlainRadiance integrate_segment_by_rule(PieceRule rule, const PolynomialSegment& segment,
                                        const PiecewiseLinear<3>& color,
                                        const PiecewiseLinear<1>& extinction, Glow glow) {
  if (rule == PieceRule::exact)
    throw std::invalid_argument("the exact integral of a segment has bounds: integrate_segment");
  std::vector<double> places;
  add_cuts(segment.color_field, color, places);
  add_cuts(segment.extinction_field, extinction, places);
  std::ranges::sort(places);
  places.push_back(1);
  PlainRadiance sum;
  double t = 0;
  for (const double next : places) {
    if (next <= t) continue;
    const CutPiece piece(segment, color, extinction, t, next);
    sum.add_behind(rule == PieceRule::mean_color ? piece.mean_color(glow)
                                                 : piece.five_points(glow));
    t = next;
  }
  return sum;
}

}  // namespace hiac
