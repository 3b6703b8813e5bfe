#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

namespace hiac {

/// The meaning of a volume's colour function; I is the radiance, t the distance from the eye.
enum class Glow : std::uint8_t {
  chromaticity,  ///< kappa: dI/dt = kappa tau - tau I (Williams and Max)
  emission       ///< g: dI/dt = g - tau I (Wilhelms and Van Gelder)
};

/// A piecewise-linear function of a scalar with `N` channels, constant outside its points: the form
/// of every transfer function (Williams, Max, Stein 1998, section 4).
///
/// The points are sorted by scalar (not decreasing). Two points at the same scalar make a step; of
/// three or more points at the same scalar, only the first and the last have an effect. The
/// function is continuous from the right at a step. Points between which the slope would overflow
/// make a step at the second one.
///
/// Intervals: with breakpoints s_0 < s_1 < ... < s_{m-1} (the distinct scalars), interval 0 is
/// (-inf, s_0), interval k is [s_{k-1}, s_k), interval m is [s_{m-1}, inf). On each interval the
/// function is linear, so `m + 1 == intervals()`.
template <std::size_t N>
class PiecewiseLinear {
 public:
  using Value = std::array<double, N>;

  struct Point {
    double scalar;
    Value value;
  };

  /// The function on one interval: value(s) = value + slope (s - anchor).
  struct Piece {
    double anchor;
    Value value;
    Value slope;

    [[nodiscard]] double channel(std::size_t c, double s) const {
      return value[c] + slope[c] * (s - anchor);
    }
  };

  /// Zero everywhere.
  PiecewiseLinear() : pieces_(1, Piece{0, {}, {}}) {}

  /// Throws std::invalid_argument when there is no point, or scalars decrease or are not finite.
  explicit PiecewiseLinear(std::span<const Point> points) {
    if (points.empty()) throw std::invalid_argument("a transfer function needs at least one point");
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!(points[i].scalar - points[i].scalar == 0))
        throw std::invalid_argument("a transfer function's scalars must be finite");
      if (i > 0 && points[i].scalar < points[i - 1].scalar)
        throw std::invalid_argument("a transfer function's scalars must not decrease");
    }
    pieces_.push_back({points.front().scalar, points.front().value, {}});
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (breakpoints_.empty() || points[i].scalar > breakpoints_.back())
        breakpoints_.push_back(points[i].scalar);
      if (i + 1 < points.size() && points[i + 1].scalar > points[i].scalar)
        pieces_.push_back(piece_between(points[i], points[i + 1]));
    }
    pieces_.push_back({points.back().scalar, points.back().value, {}});
  }

  /// s_0 < s_1 < ... : where the function may bend or jump.
  [[nodiscard]] std::span<const double> breakpoints() const { return breakpoints_; }
  [[nodiscard]] std::size_t intervals() const { return pieces_.size(); }
  [[nodiscard]] const Piece& piece(std::size_t interval) const { return pieces_[interval]; }

  /// Returns the interval that contains s.
  [[nodiscard]] std::size_t interval_of(double s) const {
    return static_cast<std::size_t>(std::upper_bound(breakpoints_.begin(), breakpoints_.end(), s) -
                                    breakpoints_.begin());
  }

  /// The function's value at s.
  [[nodiscard]] Value operator()(double s) const {
    const Piece& p = pieces_[interval_of(s)];
    Value v;
    for (std::size_t c = 0; c < N; ++c) v[c] = p.channel(c, s);
    return v;
  }

 private:
  static Piece piece_between(const Point& a, const Point& b) {
    Piece p{a.scalar, a.value, {}};
    for (std::size_t c = 0; c < N; ++c) {
      p.slope[c] = (b.value[c] - a.value[c]) / (b.scalar - a.scalar);
      // the slope overflows, as the scalars are too close together: a step
      if (!(std::abs(p.slope[c]) <= std::numeric_limits<double>::max())) p.slope[c] = 0;
    }
    return p;
  }

  std::vector<double> breakpoints_;
  std::vector<Piece> pieces_;
};

}  // namespace hiac
