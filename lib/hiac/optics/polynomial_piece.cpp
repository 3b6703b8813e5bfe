// Based on: L. N. Trefethen, "Approximation Theory and Approximation Practice", 2013, theorem 19.3:
// for a function that is analytic in the Bernstein ellipse of parameter rho and at most M there,
// the error of n-node Gauss-Legendre quadrature is at most (64/15) M rho^(-2n) / (1 - rho^-2). The
// bound M follows from Chebyshev coefficients: |T_k| <= (rho^k + rho^-k) / 2 on that ellipse.
#include "hiac/optics/polynomial_piece.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "hiac/base/gauss_legendre.hpp"
#include "hiac/optics/linear_piece.hpp"
#include "hiac/optics/transfer_course.hpp"

namespace hiac {
namespace {

constexpr int kDeepestBisection = 60;
constexpr double kMostNegative = 0x1p-6;  // rounding may turn a zero optical depth into this

template <class Real>
BasicGaussRule<Real> gauss_rule(std::size_t n) {
  if constexpr (std::is_same_v<Real, double>)
    return gauss_legendre(n);
  else
    return extended_gauss_legendre(n);
}

/// Returns an upper bound of exp(x) - 1 for x >= 0 that is cheap for small x.
template <class Real>
Real growth(Real x) {
  return x < 0.5 ? x + x * x : std::expm1(x);
}

/// The optics of a piece [t0, t1] of the segment, parametrized by x in [-1, 1]. `half_length` is
/// half its length in world units.
template <class Real>
struct Piece {
  Real t0;
  Real t1;
  Real half_length;
  const FunctionPiece<3, Real>* color;
  BasicChebyshev<Real> color_field;
  BasicChebyshev<Real> tau;
  BasicChebyshev<Real> depth;  ///< A(x), with A(-1) = 0
  Real total_depth;            ///< A(1)
  Real steepest_color;         ///< largest slope of a channel, as a function of the field
  Real largest_color;          ///< bounds of |colour| and of
  Real largest_tau;            ///< |tau| on the piece
  Real color_error;            ///< rounding bound of colour values
  Real tau_error;              ///< rounding bound of extinction values
  Real depth_error;            ///< rounding bound of A

  /// The constant Chebyshev coefficient of channel c's colour; the others are slope times the
  /// field's.
  [[nodiscard]] Real mean_color(std::size_t c) const { return color->channel(c, color_field.c[0]); }
  [[nodiscard]] Real largest_mean_color() const {
    Real largest = 0;
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(mean_color(c)));
    return largest;
  }
};

template <class Real>
Real steepest_slope(const FunctionPiece<3, Real>& color) {
  Real steepest = 0;
  for (const Real s : color.slope) steepest = std::max(steepest, std::abs(s));
  return steepest;
}

/// A(x) = half_length int_{-1}^x tau, term by term.
template <class Real>
BasicChebyshev<Real> optical_depth(const BasicChebyshev<Real>& tau, Real half_length) {
  BasicChebyshev<Real> a;
  a.degree = tau.degree + 1;
  Real at_front = 0;
  for (std::size_t k = 1; k <= a.degree; ++k) {
    const Real below = (k == 1 ? 2 : 1) * tau.c[k - 1];
    const Real above = k + 1 <= tau.degree ? tau.c[k + 1] : 0;
    a.c[k] = half_length * (below - above) / (2 * static_cast<Real>(k));
    at_front += k % 2 == 0 ? a.c[k] : -a.c[k];
  }
  a.c[0] = -at_front;
  return a;
}

/// The rule for a piece: the number of nodes and its error bound. The number is 0 if even the
/// largest rule exceeds the allowed error.
template <class Real>
struct Rule {
  std::size_t nodes;
  Real bound;
};

/// An ellipse to choose from, and the parts of its error bound 64/15 M rho^(-2n) / (1 - rho^-2).
template <class Real>
struct RuleEllipse {
  BasicBernsteinEllipse<Real> ellipse;
  double log_rate;    ///< 2 log(rho)
  double log_factor;  ///< log(64/15 / (1 - rho^-2))

  explicit RuleEllipse(double rho)
      : ellipse(rho),
        log_rate(2 * std::log(rho)),
        log_factor(std::log(64.0 / 15.0 / (1 - 1 / (rho * rho)))) {}
};

/// The ellipses to choose from, largest first.
template <class Real>
const std::array<RuleEllipse<Real>, 9>& rule_ellipses() {
  using E = RuleEllipse<Real>;
  static const std::array<E, 9> all{E(256), E(128), E(64), E(32), E(16), E(8), E(4), E(2), E(1.5)};
  return all;
}

/// Chooses the ellipse that needs the fewest nodes. `allowed` > 0. As rho grows, the number falls
/// and then rises: the logarithm of the integrand's bound is convex in log(rho).
template <class Real>
Rule<Real> choose_rule(const Piece<Real>& piece, Glow glow, Real allowed) {
  const Real log_allowed = std::log(allowed);
  const Real mean_color = piece.largest_mean_color();
  Rule<Real> best{0, 0};
  Real fewest = kMaxGaussNodes + 1;
  Real log_bound = 0;  // of the best
  Real previous = std::numeric_limits<Real>::infinity();
  for (const RuleEllipse<Real>& e : rule_ellipses<Real>()) {
    const Real color =
        mean_color + piece.steepest_color * ellipse_bound(piece.color_field, e.ellipse, 1);
    Real largest = piece.half_length * color;
    if (glow == Glow::chromaticity) largest *= ellipse_bound(piece.tau, e.ellipse, 0);
    if (largest == 0) return {2, 0};
    const Real exponent = ellipse_bound(piece.depth, e.ellipse, 1) - piece.depth.c[0];
    const Real log_front = e.log_factor + std::log(largest) + exponent;
    const Real needed = std::max<Real>(2, std::ceil((log_front - log_allowed) / e.log_rate));
    if (needed < fewest) {
      fewest = needed;
      best.nodes = static_cast<std::size_t>(needed);
      log_bound = log_front - needed * e.log_rate;
    }
    if (needed == 2 || needed > previous) break;
    previous = needed;
  }
  if (best.nodes != 0) best.bound = std::exp(log_bound);
  return best;
}

/// Integrates a segment piece by piece, front to back.
template <class Real>
class Walk {
 public:
  Walk(const BasicPolynomialSegment<Real>& segment, const PiecewiseLinear<3>& color,
       const PiecewiseLinear<1>& extinction, Glow glow, Real tolerance)
      : color_(segment.color_field, color),
        extinction_(segment.extinction_field, extinction),
        length_(segment.length),
        glow_(glow),
        tolerance_(tolerance) {
    if (!(length_ >= 0 && length_ <= kLargestCoefficient))
      throw std::invalid_argument("a ray segment's length must be finite and not negative");
    if (!(tolerance > 0)) throw std::invalid_argument("the tolerance must be positive");
  }

  BasicSegmentRadiance<Real> run() {
    Cuts<Real> cuts;
    cuts.color_doubt = add_cuts(color_, cuts.places);
    cuts.extinction_doubt = add_cuts(extinction_, cuts.places);
    std::ranges::sort(cuts.places);
    cuts.places.push_back(1);
    depth_error_ = length_ * cuts.extinction_doubt;
    Real t = 0;
    for (const Real next : cuts.places) {
      if (next <= t) continue;
      integrate_between_cuts(t, next);
      t = next;
    }
    return result(cuts);
  }

 private:
  void integrate_between_cuts(Real t0, Real t1) {
    const Real middle = static_cast<Real>(0.5) * (t0 + t1);
    color_piece_ = color_.shifted_piece(interval_around(color_, middle));
    extinction_piece_ = extinction_.shifted_piece(interval_around(extinction_, middle));
    check_functions();
    integrate(t0, t1, 0);
  }

  void integrate(Real t0, Real t1, int bisections) {
    const Piece<Real> piece = piece_on(t0, t1);
    if (!is_sound(piece)) return add_between_ends(piece);
    if (integrate_whole(piece, bisections >= kDeepestBisection)) return;
    const Real middle = static_cast<Real>(0.5) * (t0 + t1);
    integrate(t0, middle, bisections + 1);
    integrate(middle, t1, bisections + 1);
  }

  [[nodiscard]] Piece<Real> piece_on(Real t0, Real t1) const {
    Piece<Real> p;
    p.t0 = t0;
    p.t1 = t1;
    p.half_length = static_cast<Real>(0.5) * (t1 - t0) * length_;
    p.color = &color_piece_;
    p.color_field = restricted(color_.variation, t0, t1);
    p.tau = restricted(extinction_.variation, t0, t1);
    const Real slope = extinction_piece_.slope[0];
    p.tau.c[0] = extinction_piece_.channel(0, p.tau.c[0]);
    for (std::size_t k = 1; k <= p.tau.degree; ++k) p.tau.c[k] *= slope;
    p.depth = optical_depth(p.tau, p.half_length);
    p.total_depth = evaluate(p.depth, 1);
    p.steepest_color = steepest_slope(color_piece_);
    p.largest_color = p.largest_mean_color() + p.steepest_color * magnitude_sum(p.color_field, 1);
    p.largest_tau = magnitude_sum(p.tau, 0);
    set_rounding_bounds(p, std::abs(slope));
    return p;
  }

  void set_rounding_bounds(Piece<Real>& p, Real tau_slope) const {
    p.color_error =
        p.steepest_color * (color_.field_error + 4 * kRuleUnit<Real> * std::abs(p.color->anchor)) +
        4 * kRuleUnit<Real> * p.largest_color;
    p.tau_error = tau_slope * (extinction_.field_error +
                               4 * kRuleUnit<Real> * std::abs(extinction_piece_.anchor)) +
                  4 * kRuleUnit<Real> * p.largest_tau;
    const auto terms = static_cast<Real>(p.depth.degree + 1);
    p.depth_error =
        2 * p.half_length * (p.tau_error + 4 * terms * terms * kRuleUnit<Real> * p.largest_tau);
  }

  void check_functions() const {
    const Real tau = extinction_piece_.value[0];
    if (tau < 0) throw std::invalid_argument("the extinction must not be negative");
    for (const Real value :
         {tau, color_piece_.value[0], color_piece_.value[1], color_piece_.value[2]})
      if (!std::isfinite(static_cast<double>(value * length_)))
        throw std::invalid_argument("the optical depth or colour along a ray is not finite");
  }

  /// Returns false if functions are so steep that rounding errors of the field make the depth
  /// meaningless.
  [[nodiscard]] bool is_sound(const Piece<Real>& p) const {
    // slopes are rounded, which may turn functions that are not negative into slightly negative
    // ones
    const Real slack = 0x1p-50 * p.half_length * std::abs(extinction_piece_.value[0]);
    return std::isfinite(p.total_depth) && std::isfinite(crude_bound(p)) &&
           std::isfinite(p.depth_error) &&
           p.total_depth >= -std::min<Real>(2 * p.depth_error + slack, kMostNegative);
  }

  /// Returns a function's channel at t, at least 0, with the field clamped to the function's
  /// interval on the piece.
  template <std::size_t N>
  static Real kept_value(const Course<N, Real>& course, const Piece<Real>& p, std::size_t c,
                         Real t) {
    const std::size_t k = interval_around(course, static_cast<Real>(0.5) * (p.t0 + p.t1));
    const auto breakpoints = course.function.breakpoints();
    Real s = evaluate(course.field, t);
    if (k > 0) s = std::max<Real>(s, breakpoints[k - 1]);
    if (k < breakpoints.size()) s = std::min<Real>(s, breakpoints[k]);
    const auto& f = course.function.piece(k);
    return std::max<Real>(0, f.value[c] + f.slope[c] * (s - f.anchor));
  }

  /// Adds the piece as if extinction and colour were linear from end to end; the error is
  /// unbounded.
  void add_between_ends(const Piece<Real>& p) {
    const Real length = 2 * p.half_length, front = std::exp(-depth_);
    const auto b = static_cast<double>(length * kept_value(extinction_, p, 0, p.t0));
    const auto a = static_cast<double>(length * kept_value(extinction_, p, 0, p.t1));
    const bool emits = glow_ == Glow::emission;
    const LinearPieceWeights w = emits ? linear_piece_emission(b, a) : linear_piece_weights(b, a);
    const Real unit = emits ? length : 1;
    for (std::size_t c = 0; c < 3; ++c)
      rgb_[c] +=
          front * unit *
          (w.front * kept_value(color_, p, c, p.t0) + w.back * kept_value(color_, p, c, p.t1));
    depth_ += static_cast<Real>(0.5) * b + static_cast<Real>(0.5) * a;
    error_ = depth_error_ = std::numeric_limits<Real>::infinity();
  }

  /// Adds the piece if a rule meets its share of the tolerance, or in any case if `at_last` is set.
  bool integrate_whole(const Piece<Real>& piece, bool at_last) {
    const Real front = std::exp(-depth_);
    const Real opacity = -std::expm1(-piece.total_depth);
    const Real share = tolerance_ * (piece.t1 - piece.t0);
    const Real spread = piece.steepest_color * magnitude_sum(piece.color_field, 1);
    if (glow_ == Glow::chromaticity && front * spread * opacity <= share) {
      add_mean_color(piece, front, opacity, spread * opacity);
      return true;
    }
    const Real rounding = rounding_bound(piece, opacity);
    const Real largest_error = crude_bound(piece);
    if (front * largest_error <= share || at_last) {
      add_by_rule(piece, front, {2, largest_error}, rounding);
      return true;
    }
    const Rule<Real> rule = choose_rule(piece, glow_, std::max(share / front, rounding));
    if (rule.nodes == 0) return false;
    add_by_rule(piece, front, rule, rounding);
    return true;
  }

  /// Twice an upper bound of the magnitude of the integral, and of any rule with positive weights.
  [[nodiscard]] Real crude_bound(const Piece<Real>& piece) const {
    const Real largest = piece.largest_color * 4 * piece.half_length;
    return glow_ == Glow::emission ? largest : largest * piece.largest_tau;
  }

  /// Bounds the rounding error of a rule's sum: that of colour, extinction and depth, and that of
  /// the rest relative to the sum.
  [[nodiscard]] Real rounding_bound(const Piece<Real>& piece, Real opacity) const {
    const Real color = piece.largest_color;
    const Real relative = growth(piece.depth_error) + 2 * (kMaxGaussNodes + 16) * kRuleUnit<Real>;
    const Real length = 2 * piece.half_length;
    const Real tau = piece.largest_tau;
    const Real nodes = kRuleUnit<Real> * steepness(piece, tau);  // nodes are off by up to a unit
    if (glow_ == Glow::emission) return length * (piece.color_error + color * (relative + nodes));
    const Real weight = std::min<Real>(1, opacity + piece.depth_error);
    return weight * (piece.color_error + color * relative) +
           color * length * (piece.tau_error * (1 + relative) + tau * nodes);
  }

  /// Bounds the integrand's derivative in x, relative to the integrand's bound (Markov's
  /// inequality).
  static Real steepness(const Piece<Real>& piece, Real tau) {
    const auto color_degree = static_cast<Real>(piece.color_field.degree);
    const auto tau_degree = static_cast<Real>(piece.tau.degree);
    return color_degree * color_degree + tau_degree * tau_degree + piece.half_length * tau;
  }

  /// For chromaticity with a constant colour, the radiance is exactly that colour times the
  /// opacity.
  void add_mean_color(const Piece<Real>& piece, Real front, Real opacity, Real bound) {
    for (std::size_t c = 0; c < 3; ++c) rgb_[c] += front * opacity * piece.mean_color(c);
    const Real largest = piece.largest_color;
    const Real depth_effect = std::min<Real>(1, (1 - opacity) * growth(piece.depth_error));
    add_errors(piece, front, largest * opacity,
               bound + opacity * piece.color_error +
                   largest * (depth_effect + 8 * kRuleUnit<Real> * opacity));
  }

  void add_by_rule(const Piece<Real>& piece, Real front, const Rule<Real>& rule, Real rounding) {
    const BasicGaussRule<Real> gauss = gauss_rule<Real>(rule.nodes);
    std::array<Real, 3> sum{};
    for (std::size_t i = 0; i < rule.nodes; ++i) {
      const Real x = gauss.nodes[i];
      Real weight = gauss.weights[i] * std::exp(-evaluate(piece.depth, x));
      if (glow_ == Glow::chromaticity) weight *= evaluate(piece.tau, x);
      const Real field = evaluate(piece.color_field, x);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * piece.color->channel(c, field);
    }
    Real largest = 0;
    const Real most =
        2 * piece.largest_color * (glow_ == Glow::emission ? 2 * piece.half_length : 1);
    for (const Real channel : sum) {
      largest = std::max(largest, std::abs(piece.half_length * channel));
      if (!(std::abs(piece.half_length * channel) <= most)) return add_between_ends(piece);
    }
    for (std::size_t c = 0; c < 3; ++c) rgb_[c] += front * (piece.half_length * sum[c]);
    add_errors(piece, front, largest, rule.bound + rounding);
  }

  /// `error` is the error of this piece's own radiance. `largest` is the radiance's magnitude, by
  /// which the error of the transparency in front is multiplied.
  void add_errors(const Piece<Real>& piece, Real front, Real largest, Real error) {
    const Real front_error = front * growth(depth_error_ + 4 * kRuleUnit<Real>);
    error_ += (front + front_error) * error + front_error * largest;
    error_ += 4 * kRuleUnit<Real> * (std::abs(rgb_[0]) + std::abs(rgb_[1]) + std::abs(rgb_[2]));
    depth_ += piece.total_depth;
    depth_error_ += piece.depth_error + kRuleUnit<Real> * depth_;
    largest_color_ = std::max(largest_color_, piece.largest_color);
    largest_tau_ = std::max(largest_tau_, piece.largest_tau);
  }

  [[nodiscard]] BasicSegmentRadiance<Real> result(const Cuts<Real>& cuts) const {
    const bool emits = glow_ == Glow::emission;
    const Real color_weight = length_ * (emits ? 1 : largest_tau_);
    const Real direct = emits ? 0 : largest_color_ * length_ * cuts.extinction_doubt;
    const Real transparency = std::exp(-depth_);
    const auto error = static_cast<double>(error_ + color_weight * cuts.color_doubt + direct);
    // 0, of what is not visible, times an unbounded error is no number
    return {rgb_, transparency, std::isnan(error) ? std::numeric_limits<double>::infinity() : error,
            static_cast<double>(
                std::min<Real>(1, transparency * growth(depth_error_ + 4 * kRuleUnit<Real>) +
                                      std::numeric_limits<double>::denorm_min()))};
  }

  Course<3, Real> color_;
  Course<1, Real> extinction_;
  Real length_;
  Glow glow_;
  Real tolerance_;

  FunctionPiece<3, Real> color_piece_{};  ///< on the current stretch between cuts
  FunctionPiece<1, Real> extinction_piece_{};

  std::array<Real, 3> rgb_{};
  Real depth_ = 0;
  Real error_ = 0;
  Real depth_error_ = 0;  ///< error bound of depth_
  Real largest_color_ = 0;
  Real largest_tau_ = 0;
};

}  // namespace

SegmentRadiance integrate_segment(const PolynomialSegment& segment, const PiecewiseLinear<3>& color,
                                  const PiecewiseLinear<1>& extinction, Glow glow,
                                  double tolerance) {
  return Walk<double>(segment, color, extinction, glow, tolerance).run();
}

BasicSegmentRadiance<long double> integrate_segment(
    const BasicPolynomialSegment<long double>& segment, const PiecewiseLinear<3>& color,
    const PiecewiseLinear<1>& extinction, Glow glow, double tolerance) {
  return Walk<long double>(segment, color, extinction, glow, tolerance).run();
}

}  // namespace hiac
