// Opacity between two points follows vtkPiecewiseFunction: a curve of the position s that its
// midpoint stretches, for sharpness k in [0.01, 0.99]
//
//     p = 2^n s^n / 2 up to the middle, mirrored above it, n = 1 + 10 k
//     y = y0 + (y1 - y0) ((1 - k) p + k (3 p^2 - 2 p^3)),
//
// a straight line for less sharpness, and a step for more. (VTK writes the same as a cubic Hermite
// curve with the slopes (1 - k) (y1 - y0).)

#include "hiac/scene/paraview/opacity_function.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace hiac::paraview {
namespace {

struct OpacityNode {
  double position;
  double opacity;
  double midpoint;
  double sharpness;
};

constexpr double kStraight = 0.01, kStep = 0.99;  // sharpness: less is a line, more is a step
constexpr double kMidpointMargin = 1e-5;

/// The largest single-precision number below 1, in which ParaView's tables hold opacities.
constexpr double kLargestOpacity = 1 - 0x1p-24;

/// Half of the curve between two points, from its end at t = 0 to the middle at t = 1. Its slope
/// does not decrease: p and the polynomial of p are convex there.
struct HalfCurve {
  double end;        ///< opacity at t = 0
  double rise;       ///< from there to the point beyond the middle
  double sharpness;  ///< 0 or in [0.01, 0.99]

  [[nodiscard]] double exponent() const { return 1 + 10 * sharpness; }
  [[nodiscard]] double opacity(double t) const {
    const double p = 0.5 * std::pow(t, exponent());
    return end + rise * ((1 - sharpness) * p + sharpness * p * p * (3 - 2 * p));
  }
  [[nodiscard]] double slope(double t) const {
    const double p = 0.5 * std::pow(t, exponent());
    const double dp = 0.5 * exponent() * std::pow(t, exponent() - 1);
    return rise * ((1 - sharpness) + 6 * sharpness * p * (1 - p)) * dp;
  }
};

/// Follows half curves by straight lines.
class Follower {
 public:
  Follower(double unit, ExtinctionLaw law, double tolerance)
      : unit_(unit), law_(law), tolerance_(tolerance) {}

  /// The positions t in (0, 1], ascending, between which straight lines differ from the extinction
  /// by at most the tolerance.
  std::vector<double> positions(const HalfCurve& curve) {
    std::vector<double> found;
    append(curve, 0, 1, found);
    return found;
  }

  [[nodiscard]] double extinction_at(const HalfCurve& curve, double t) const {
    return extinction(curve.opacity(t), unit_, law_);
  }
  [[nodiscard]] double bound() const { return bound_; }

 private:
  /// Values between which the derivative of the extinction by the opacity lies, for opacities
  /// between two: it grows with the opacity, up to kLargestOpacity, beyond which it is 0.
  [[nodiscard]] std::array<double, 3> law_slopes(double o1, double o2) const {
    if (law_ == ExtinctionLaw::proportional) return {1 / unit_, 1 / unit_, 1 / unit_};
    const auto slope = [&](double o) { return 1 / ((1 - std::min(o, kLargestOpacity)) * unit_); };
    return {slope(o1), slope(o2), std::max(o1, o2) > kLargestOpacity ? 0 : slope(o1)};
  }

  /// Bounds the distance of the extinction from the line over [a, b] by the mean value theorem: the
  /// two factors of its slope lie between their values at a and b.
  [[nodiscard]] double error_bound(const HalfCurve& curve, double a, double b) const {
    const double va = extinction_at(curve, a), vb = extinction_at(curve, b);
    const double line = (vb - va) / (b - a), middle = 0.5 * (a + b);
    double steepest = 0;
    for (const double factor : law_slopes(curve.opacity(a), curve.opacity(b)))
      for (const double slope : {curve.slope(a), curve.slope(b)})
        steepest = std::max(steepest, std::fabs(factor * slope - line));
    const double at_middle = std::fabs(extinction_at(curve, middle) - 0.5 * (va + vb));
    return std::min(at_middle + 0.5 * (b - a) * steepest, std::fabs(vb - va));  // it is monotone
  }

  void append(const HalfCurve& curve, double a, double b, std::vector<double>& found) {
    constexpr double kShortest = 1e-15;
    const double error = error_bound(curve, a, b);
    if (error <= tolerance_ || b - a < kShortest) {
      found.push_back(b);
      bound_ = std::max(bound_, error);
      return;
    }
    append(curve, a, 0.5 * (a + b), found);
    append(curve, 0.5 * (a + b), b, found);
  }

  double unit_;
  ExtinctionLaw law_;
  double tolerance_;
  double bound_ = 0;
};

std::vector<OpacityNode> opacity_nodes(const Proxy& function) {
  const std::vector<double> numbers = function.numbers("Points");
  if (numbers.empty() || numbers.size() % 4 != 0)
    function.fail("Points", fmt::format("expected scalar, opacity, midpoint and sharpness for "
                                        "every point, found {} numbers",
                                        numbers.size()));
  std::vector<OpacityNode> nodes;
  for (std::size_t i = 0; i < numbers.size(); i += 4) {
    for (std::size_t c = 1; c < 4; ++c)
      if (!(numbers[i + c] >= 0 && numbers[i + c] <= 1))
        function.fail("Points", fmt::format("opacity, midpoint and sharpness are 0 to 1, found {}",
                                            numbers[i + c]));
    nodes.push_back({numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]});
  }
  std::ranges::stable_sort(nodes, {}, &OpacityNode::position);
  if (!std::isfinite(nodes.back().position - nodes.front().position))
    function.fail("Points", "the scalars' range is not finite");
  return nodes;
}

/// Appends the points after `a` up to and including `b`.
void append_curve(const OpacityNode& a, const OpacityNode& b, Follower& follower,
                  std::vector<PiecewiseLinear<1>::Point>& points) {
  const double share = std::clamp(a.midpoint, kMidpointMargin, 1 - kMidpointMargin);
  const double middle =
      std::clamp(a.position + share * (b.position - a.position), a.position, b.position);
  const double rise = b.opacity - a.opacity;
  const auto add = [&](double position, const HalfCurve& curve, double t) {
    points.push_back({position, {follower.extinction_at(curve, t)}});
  };
  if (a.sharpness > kStep) {
    add(middle, {a.opacity, rise, 0}, 0);
    add(middle, {b.opacity, -rise, 0}, 0);
    add(b.position, {b.opacity, -rise, 0}, 0);
    return;
  }
  const double sharpness = a.sharpness < kStraight ? 0 : a.sharpness;
  const HalfCurve first{a.opacity, rise, sharpness}, second{b.opacity, -rise, sharpness};
  for (const double t : follower.positions(first))
    add(a.position + t * (middle - a.position), first, t);
  const std::vector<double> back = follower.positions(second);
  for (std::size_t k = back.size(); k-- > 0;) {
    const double t = k > 0 ? back[k - 1] : 0;
    add(b.position + t * (middle - b.position), second, t);
  }
}

}  // namespace

double extinction(double opacity, double unit, ExtinctionLaw law) {
  if (law == ExtinctionLaw::proportional) return opacity / unit;
  return -std::log1p(-std::min(opacity, kLargestOpacity)) / unit;
}

OpacityFunction read_opacity_function(const Proxy& function, double unit, ExtinctionLaw law) {
  std::vector<OpacityNode> nodes = opacity_nodes(function);
  OpacityFunction found;
  found.axis = axis_of(function, nodes.front().position, nodes.back().position);
  for (OpacityNode& node : nodes) node.position = found.axis.position(node.position);
  const double largest = std::ranges::max_element(nodes, {}, &OpacityNode::opacity)->opacity;
  found.is_opaque = largest == 1;
  Follower follower(unit, law, kExtinctionShare * extinction(largest, unit, law));
  found.points.push_back({nodes.front().position, {extinction(nodes.front().opacity, unit, law)}});
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    if (nodes[i].position < nodes[i + 1].position)
      append_curve(nodes[i], nodes[i + 1], follower, found.points);
    else
      found.points.push_back(
          {nodes[i + 1].position, {extinction(nodes[i + 1].opacity, unit, law)}});
  }
  for (std::size_t i = 1; i < found.points.size(); ++i)  // rounding lets none fall below another
    found.points[i].scalar = std::max(found.points[i].scalar, found.points[i - 1].scalar);
  found.bound = follower.bound();
  return found;
}

}  // namespace hiac::paraview
