// Based on: L. N. Trefethen, "Approximation Theory and Approximation Practice", 2013, theorem 19.3:
// n-node Gauss-Legendre quadrature of a function that is analytic in the Bernstein ellipse of
// parameter rho and at most M there errs by at most (64/15) M rho^(-2n) / (1 - rho^-2). The bound M
// comes from Chebyshev coefficients: |T_k| <= (rho^k + rho^-k) / 2 on that ellipse.
#include "hiac/optics/polynomial_piece.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "hiac/optics/gauss_legendre.hpp"
#include "hiac/optics/polynomial_roots.hpp"

namespace hiac {
namespace {

constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;
constexpr double kLargestCoefficient = 1e150;  // differences and slopes of such do not overflow
constexpr int kDeepestBisection = 60;

/// At least exp(x) - 1, x >= 0, at no cost where x is small.
double growth(double x) { return x < 0.5 ? x + x * x : std::expm1(x); }

/// Where the segment is cut, and what doubts about the places cost: integrals over t of the bound
/// of what each transfer function's value is wrong by.
struct Cuts {
  std::vector<double> places;
  double color_doubt = 0;
  double extinction_doubt = 0;
};

/// A transfer function along a segment. Fields are measured from their value at the segment's
/// front, so that a small variation of large numbers keeps its digits.
template <std::size_t N>
struct Course {
  const BernsteinPolynomial& field;
  const PiecewiseLinear<N>& function;
  ChebyshevPolynomial variation;  ///< field - field(0)
  double field_error = 0;         ///< bound of the rounding error of `variation` on a piece

  Course(const BernsteinPolynomial& f, const PiecewiseLinear<N>& transfer_function)
      : field(f), function(transfer_function) {
    BernsteinPolynomial shifted = f;
    double largest = 0;
    for (std::size_t i = 0; i <= f.degree; ++i) {
      if (!(std::abs(f.c[i]) <= kLargestCoefficient))
        throw std::invalid_argument("a field along a ray must be finite and at most 1e150");
      shifted.c[i] -= f.c[0];
      largest = std::max(largest, std::abs(shifted.c[i]));
    }
    variation = chebyshev_from_bernstein(shifted);
    // ample for a change of basis (n + 1 terms, whose factors add up to 2 at most), a transform
    // (n + 1 terms, n + 1 coefficients) and Clenshaw's recurrence twice (errors up to n times 4 n),
    // each relative to `largest`
    const auto n = static_cast<double>(f.degree);
    field_error = (1 + 3 * n + 4 * (n + 1) * (n + 1) + 8 * n * n) * kUnit * largest;
  }

  /// The function on interval k, as a function of the variation.
  [[nodiscard]] typename PiecewiseLinear<N>::Piece shifted_piece(std::size_t k) const {
    typename PiecewiseLinear<N>::Piece p = function.piece(k);
    p.anchor -= field.c[0];
    return p;
  }
};

/// Bounds of how much a transfer function jumps and bends at breakpoint k.
struct Break {
  double jump = 0;
  double bend = 0;
};

template <std::size_t N>
Break break_at(const PiecewiseLinear<N>& f, std::size_t k) {
  const double s = f.breakpoints()[k];
  const auto& before = f.piece(k);
  const auto& after = f.piece(k + 1);
  Break b;
  for (std::size_t c = 0; c < N; ++c) {
    b.jump = std::max(b.jump, std::abs(after.channel(c, s) - before.channel(c, s)));
    b.bend = std::max(b.bend, std::abs(after.slope[c] - before.slope[c]));
  }
  return b;
}

/// Adds the places where the field crosses breakpoints; returns the doubt about them.
template <std::size_t N>
double add_cuts(const Course<N>& course, std::vector<double>& places) {
  const auto breakpoints = course.function.breakpoints();
  const auto [smallest, largest] = std::ranges::minmax(course.field.coefficients());
  double doubt = 0;
  std::vector<RootEnclosure> roots;
  const auto first = std::ranges::lower_bound(breakpoints, smallest);
  for (auto s = first; s != breakpoints.end() && *s <= largest; ++s) {
    roots.clear();
    append_roots(course.field, *s, roots);
    const Break b = break_at(course.function, static_cast<std::size_t>(s - breakpoints.begin()));
    for (const RootEnclosure& root : roots) {
      places.push_back(0.5 * (root.low + root.high));
      doubt += (root.high - root.low) * (b.jump + b.bend * root.deviation);
    }
  }
  return doubt;
}

/// f(t) < s, told from differences of coefficients, which keep their sign however small they are.
bool certainly_below(const BernsteinPolynomial& f, double t, double s) {
  BernsteinPolynomial difference = f;
  for (std::size_t i = 0; i <= f.degree; ++i) difference.c[i] -= s;
  return evaluate(difference, t) < 0;
}

/// The interval of the transfer function on a piece around t.
template <std::size_t N>
std::size_t interval_around(const Course<N>& course, double t) {
  const auto breakpoints = course.function.breakpoints();
  const auto [smallest, largest] = std::ranges::minmax(course.field.coefficients());
  std::size_t k = course.function.interval_of(smallest);
  if (k == course.function.interval_of(largest)) return k;
  k = course.function.interval_of(evaluate(course.field, t));
  while (k > 0 && certainly_below(course.field, t, breakpoints[k - 1])) --k;
  while (k < breakpoints.size() && !certainly_below(course.field, t, breakpoints[k])) ++k;
  return k;
}

/// Optics on a piece [t0, t1] of the segment, x in [-1, 1] running over it. `half_length` is half
/// its length in the world.
struct Piece {
  double t0;
  double t1;
  double half_length;
  const PiecewiseLinear<3>::Piece* color;
  ChebyshevPolynomial color_field;
  ChebyshevPolynomial tau;
  ChebyshevPolynomial depth;  ///< A(x), with A(-1) = 0
  double total_depth;         ///< A(1)
  double largest_color;       ///< bounds of |colour| and
  double largest_tau;         ///< |tau| on the piece
  double color_error;         ///< rounding bound of colour values
  double tau_error;           ///< of extinction values
  double depth_error;         ///< of A

  /// Colour of channel c as coefficients: its constant term; the others are slope times field's.
  [[nodiscard]] double mean_color(std::size_t c) const {
    return color->channel(c, color_field.c[0]);
  }
  [[nodiscard]] double steepest_color() const {
    double steepest = 0;
    for (const double s : color->slope) steepest = std::max(steepest, std::abs(s));
    return steepest;
  }
  [[nodiscard]] double largest_mean_color() const {
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(mean_color(c)));
    return largest;
  }
  /// Bound of |colour| on the ellipse of parameter rho.
  [[nodiscard]] double color_bound(double rho) const {
    return largest_mean_color() + steepest_color() * ellipse_bound(color_field, rho, 1);
  }
};

/// A(x) = half_length int_{-1}^x tau, term by term.
ChebyshevPolynomial optical_depth(const ChebyshevPolynomial& tau, double half_length) {
  ChebyshevPolynomial a;
  a.degree = tau.degree + 1;
  double at_front = 0;
  for (std::size_t k = 1; k <= a.degree; ++k) {
    const double below = (k == 1 ? 2 : 1) * tau.c[k - 1];
    const double above = k + 1 <= tau.degree ? tau.c[k + 1] : 0;
    a.c[k] = half_length * (below - above) / (2 * static_cast<double>(k));
    at_front += k % 2 == 0 ? a.c[k] : -a.c[k];
  }
  a.c[0] = -at_front;
  return a;
}

/// The rule for a piece: its number of nodes and the bound of its error; 0 nodes when even the
/// largest rule does not meet what is allowed.
struct Rule {
  std::size_t nodes;
  double bound;
};

/// Bernstein ellipses to choose from, largest first: rho, 2 log(rho), log(64/15 / (1 - rho^-2)).
struct Ellipse {
  double rho;
  double log_rate;
  double log_factor;
};

std::array<Ellipse, 9> build_ellipses() {
  std::array<Ellipse, 9> ellipses{};
  std::size_t i = 0;
  for (const double rho : {256.0, 128.0, 64.0, 32.0, 16.0, 8.0, 4.0, 2.0, 1.5})
    ellipses[i++] = {rho, 2 * std::log(rho), std::log(64.0 / 15.0 / (1 - 1 / (rho * rho)))};
  return ellipses;
}

/// Chooses the ellipse that needs the fewest nodes. `allowed` > 0. The number needed falls and then
/// rises with rho: the logarithm of the integrand's bound is convex in log(rho).
Rule choose_rule(const Piece& piece, Glow glow, double allowed) {
  static const std::array<Ellipse, 9> ellipses = build_ellipses();
  const double log_allowed = std::log(allowed);
  Rule best{0, 0};
  double fewest = kMaxGaussNodes + 1;
  double previous = std::numeric_limits<double>::infinity();
  for (const Ellipse& e : ellipses) {
    double largest = piece.half_length * piece.color_bound(e.rho);
    if (glow == Glow::chromaticity) largest *= ellipse_bound(piece.tau, e.rho, 0);
    if (largest == 0) return {2, 0};
    const double exponent = ellipse_bound(piece.depth, e.rho, 1) - piece.depth.c[0];
    const double log_front = e.log_factor + std::log(largest) + exponent;
    const double needed = std::max(2.0, std::ceil((log_front - log_allowed) / e.log_rate));
    if (needed < fewest) {
      fewest = needed;
      best = {static_cast<std::size_t>(needed), std::exp(log_front - needed * e.log_rate)};
    }
    if (needed == 2 || needed > previous) break;
    previous = needed;
  }
  return best;
}

/// Integrates a segment piece by piece, front to back.
class Walk {
 public:
  Walk(const PolynomialSegment& segment, const PiecewiseLinear<3>& color,
       const PiecewiseLinear<1>& extinction, Glow glow, double tolerance)
      : color_(segment.color_field, color),
        extinction_(segment.extinction_field, extinction),
        length_(segment.length),
        glow_(glow),
        tolerance_(tolerance) {
    if (!(length_ >= 0 && length_ <= kLargestCoefficient))
      throw std::invalid_argument("a ray segment's length must be finite and not negative");
    if (!(tolerance > 0)) throw std::invalid_argument("the tolerance must be positive");
  }

  SegmentRadiance run() {
    Cuts cuts;
    cuts.color_doubt = add_cuts(color_, cuts.places);
    cuts.extinction_doubt = add_cuts(extinction_, cuts.places);
    std::ranges::sort(cuts.places);
    cuts.places.push_back(1);
    depth_error_ = length_ * cuts.extinction_doubt;
    double t = 0;
    for (const double next : cuts.places) {
      if (next <= t) continue;
      integrate_between_cuts(t, next);
      t = next;
    }
    return result(cuts);
  }

 private:
  void integrate_between_cuts(double t0, double t1) {
    const double middle = 0.5 * (t0 + t1);
    color_piece_ = color_.shifted_piece(interval_around(color_, middle));
    extinction_piece_ = extinction_.shifted_piece(interval_around(extinction_, middle));
    integrate(t0, t1, 0);
  }

  void integrate(double t0, double t1, int bisections) {
    const Piece piece = piece_on(t0, t1);
    if (integrate_whole(piece, bisections >= kDeepestBisection)) return;
    const double middle = 0.5 * (t0 + t1);
    integrate(t0, middle, bisections + 1);
    integrate(middle, t1, bisections + 1);
  }

  [[nodiscard]] Piece piece_on(double t0, double t1) const {
    Piece p;
    p.t0 = t0;
    p.t1 = t1;
    p.half_length = 0.5 * (t1 - t0) * length_;
    p.color = &color_piece_;
    p.color_field = restricted(color_.variation, t0, t1);
    p.tau = restricted(extinction_.variation, t0, t1);
    const double slope = extinction_piece_.slope[0];
    p.tau.c[0] = extinction_piece_.channel(0, p.tau.c[0]);
    for (std::size_t k = 1; k <= p.tau.degree; ++k) p.tau.c[k] *= slope;
    p.depth = optical_depth(p.tau, p.half_length);
    p.total_depth = evaluate(p.depth, 1);
    p.largest_color = p.color_bound(1);
    p.largest_tau = ellipse_bound(p.tau, 1, 0);
    set_rounding_bounds(p, std::abs(slope));
    check(p);
    return p;
  }

  void set_rounding_bounds(Piece& p, double tau_slope) const {
    p.color_error =
        p.steepest_color() * (color_.field_error + 4 * kUnit * std::abs(p.color->anchor)) +
        4 * kUnit * p.largest_color;
    p.tau_error =
        tau_slope * (extinction_.field_error + 4 * kUnit * std::abs(extinction_piece_.anchor)) +
        4 * kUnit * p.largest_tau;
    const auto terms = static_cast<double>(p.depth.degree + 1);
    p.depth_error = 2 * p.half_length * (p.tau_error + 4 * terms * terms * kUnit * p.largest_tau);
  }

  void check(const Piece& p) const {
    if (!std::isfinite(p.total_depth) || !std::isfinite(crude_bound(p)) ||
        !std::isfinite(p.depth_error))
      throw std::invalid_argument("the optical depth or colour along a ray is not finite");
    if (p.total_depth < -2 * p.depth_error)
      throw std::invalid_argument("the extinction must not be negative");
  }

  /// Adds the piece when a rule meets its share of the tolerance; `at_last`: with any rule.
  bool integrate_whole(const Piece& piece, bool at_last) {
    const double front = std::exp(-depth_);
    const double opacity = -std::expm1(-piece.total_depth);
    const double share = tolerance_ * (piece.t1 - piece.t0);
    const double spread = piece.steepest_color() * ellipse_bound(piece.color_field, 1, 1);
    if (glow_ == Glow::chromaticity && front * spread * opacity <= share) {
      add_mean_color(piece, front, opacity, spread * opacity);
      return true;
    }
    const double rounding = rounding_bound(piece, opacity);
    const double largest_error = crude_bound(piece);
    if (front * largest_error <= share || at_last) {
      add_by_rule(piece, front, {2, largest_error}, rounding);
      return true;
    }
    const Rule rule = choose_rule(piece, glow_, std::max(share / front, rounding));
    if (rule.nodes == 0) return false;
    add_by_rule(piece, front, rule, rounding);
    return true;
  }

  /// Both the integral and a rule with positive weights are at most half of this in magnitude.
  [[nodiscard]] double crude_bound(const Piece& piece) const {
    const double largest = piece.largest_color * 4 * piece.half_length;
    return glow_ == Glow::emission ? largest : largest * piece.largest_tau;
  }

  /// Bound of the rounding error of a rule's sum: colour, extinction and depth wrong by their
  /// errors, the rest relative to the sum.
  [[nodiscard]] double rounding_bound(const Piece& piece, double opacity) const {
    const double color = piece.largest_color;
    const double relative = growth(piece.depth_error) + 2 * (kMaxGaussNodes + 16) * kUnit;
    const double length = 2 * piece.half_length;
    const double tau = piece.largest_tau;
    const double nodes = kUnit * steepness(piece, tau);  // each node is off by a unit at most
    if (glow_ == Glow::emission) return length * (piece.color_error + color * (relative + nodes));
    const double weight = std::min(1.0, opacity + piece.depth_error);
    return weight * (piece.color_error + color * relative) +
           color * length * (piece.tau_error * (1 + relative) + tau * nodes);
  }

  /// Bound of the integrand's derivative in x, relative to its own bound (Markov's inequality).
  static double steepness(const Piece& piece, double tau) {
    const auto color_degree = static_cast<double>(piece.color_field.degree);
    const auto tau_degree = static_cast<double>(piece.tau.degree);
    return color_degree * color_degree + tau_degree * tau_degree + piece.half_length * tau;
  }

  /// Chromaticity with a constant colour is that colour times the opacity, exactly.
  void add_mean_color(const Piece& piece, double front, double opacity, double bound) {
    for (std::size_t c = 0; c < 3; ++c) rgb_[c] += front * opacity * piece.mean_color(c);
    const double largest = piece.largest_color;
    const double depth_effect = std::min(1.0, (1 - opacity) * growth(piece.depth_error));
    add_errors(
        piece, front, largest * opacity,
        bound + opacity * piece.color_error + largest * (depth_effect + 8 * kUnit * opacity));
  }

  void add_by_rule(const Piece& piece, double front, const Rule& rule, double rounding) {
    const GaussRule gauss = gauss_legendre(rule.nodes);
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < rule.nodes; ++i) {
      const double x = gauss.nodes[i];
      double weight = gauss.weights[i] * std::exp(-evaluate(piece.depth, x));
      if (glow_ == Glow::chromaticity) weight *= evaluate(piece.tau, x);
      const double field = evaluate(piece.color_field, x);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * piece.color->channel(c, field);
    }
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double radiance = piece.half_length * sum[c];
      largest = std::max(largest, std::abs(radiance));
      rgb_[c] += front * radiance;
    }
    add_errors(piece, front, largest, rule.bound + rounding);
  }

  /// `error`: of this piece's own radiance, `largest`: its magnitude, which the error of the
  /// transparency in front scales.
  void add_errors(const Piece& piece, double front, double largest, double error) {
    const double front_error = front * growth(depth_error_ + 4 * kUnit);
    error_ += (front + front_error) * error + front_error * largest;
    error_ += 4 * kUnit * (std::abs(rgb_[0]) + std::abs(rgb_[1]) + std::abs(rgb_[2]));
    depth_ += piece.total_depth;
    depth_error_ += piece.depth_error + kUnit * depth_;
    largest_color_ = std::max(largest_color_, piece.largest_color);
    largest_tau_ = std::max(largest_tau_, piece.largest_tau);
  }

  [[nodiscard]] SegmentRadiance result(const Cuts& cuts) const {
    const bool emits = glow_ == Glow::emission;
    const double color_weight = length_ * (emits ? 1 : largest_tau_);
    const double direct = emits ? 0 : largest_color_ * length_ * cuts.extinction_doubt;
    const double transparency = std::exp(-depth_);
    return {rgb_, transparency, error_ + color_weight * cuts.color_doubt + direct,
            std::min(1.0, transparency * growth(depth_error_ + 4 * kUnit) +
                              std::numeric_limits<double>::denorm_min())};
  }

  Course<3> color_;
  Course<1> extinction_;
  double length_;
  Glow glow_;
  double tolerance_;

  PiecewiseLinear<3>::Piece color_piece_{};  ///< between the cuts at hand
  PiecewiseLinear<1>::Piece extinction_piece_{};

  std::array<double, 3> rgb_{};
  double depth_ = 0;
  double error_ = 0;
  double depth_error_ = 0;  ///< bound of the error of depth_
  double largest_color_ = 0;
  double largest_tau_ = 0;
};

}  // namespace

SegmentRadiance integrate_segment(const PolynomialSegment& segment, const PiecewiseLinear<3>& color,
                                  const PiecewiseLinear<1>& extinction, Glow glow,
                                  double tolerance) {
  return Walk(segment, color, extinction, glow, tolerance).run();
}

}  // namespace hiac
