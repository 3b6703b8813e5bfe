// Radiance of ray segments through linear fields, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_SHADING_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_SHADING_INL
#    undef HIAC_RENDER_SHADING_INL
#  else
#    define HIAC_RENDER_SHADING_INL
#  endif

#  include <cstdint>
#  include <vector>

#  include <hwy/highway.h>

#  include "hiac/frame/interval_range.hpp"
#  include "hiac/frame/transfer_table.hpp"
#  include "hiac/optics/linear_piece-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The effect of a ray segment on a pixel: the light that it adds, and its transparency.
template <class V>
struct Radiance {
  V red, green, blue, transparency;
};

// Reads the columns of a transfer table at one interval for all lanes.
template <class D>
struct UniformInterval {
  std::size_t interval;

  HWY_INLINE hn::Vec<D> operator()(D d, const std::vector<double>& column) const {
    return hn::Set(d, column[interval]);
  }
};

// Reads the columns of a transfer table at every lane's interval.
template <class D>
struct LaneIntervals {
  hn::Vec<hn::RebindToSigned<D>> interval;

  HWY_INLINE hn::Vec<D> operator()(D d, const std::vector<double>& column) const {
    return hn::GatherIndex(d, column.data(), interval);
  }
};

// Reads at one interval or at every lane's interval, whichever applies at run time.
template <class D>
class IntervalReader {
 public:
  using V = hn::Vec<D>;
  using Index = hn::Vec<hn::RebindToSigned<D>>;

  IntervalReader(D d, std::size_t uniform) : d_(d), uniform_{uniform}, is_uniform_(true) {}
  IntervalReader(D d, Index lanes) : d_(d), lanes_{lanes}, is_uniform_(false) {}

  HWY_INLINE V operator()(const std::vector<double>& column) const {
    return is_uniform_ ? uniform_(d_, column) : lanes_(d_, column);
  }

 private:
  D d_;
  LaneIntervals<D> lanes_{};
  UniformInterval<D> uniform_{};
  bool is_uniform_;
};

// The table's function of channel c. `Table`: TransferTable, or another with the same columns that
// the reader of intervals knows.
template <class D, class Interval, class Table, class V = hn::Vec<D>>
HWY_INLINE V value_in(D d, const Interval& interval, const Table& table, std::size_t c, V scalar) {
  return hn::MulAdd(interval(d, table.slope[c]), hn::Sub(scalar, interval(d, table.anchor)),
                    interval(d, table.value[c]));
}

// A scalar that runs linearly from `begin` (u = 0) to `end` (u = 1), followed interval by interval.
template <class D>
class ScalarWalk {
 public:
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  using DI = hn::RebindToSigned<D>;

  template <std::size_t N>
  HWY_INLINE ScalarWalk(D d, const TransferTable<N>& table, IntervalRange range, V begin, V end)
      : d_(d),
        lower_(table.lower),
        upper_(table.upper),
        begin_(begin),
        end_(end),
        difference_(hn::Sub(end, begin)),
        now_(begin) {
    rising_ = hn::Ge(end, begin);
    inverse_ = hn::Div(hn::Set(d, 1.0), difference_);
    // rising: breakpoints at or below `begin` are passed; falling: those strictly below it
    interval_ = hn::Set(DI(), static_cast<std::int64_t>(range.low));
    for (std::size_t k = range.low; k < range.high; ++k) {
      const V breakpoint = hn::Set(d, upper_[k]);
      const M passed =
          hn::Or(hn::Gt(begin, breakpoint), hn::And(rising_, hn::Eq(begin, breakpoint)));
      interval_ = hn::Sub(interval_, hn::VecFromMask(DI(), hn::RebindMask(DI(), passed)));
    }
  }

  [[nodiscard]] HWY_INLINE LaneIntervals<D> intervals() const { return {interval_}; }
  [[nodiscard]] HWY_INLINE V now() const { return now_; }

  // Returns where the scalar leaves the current interval, not before u: 1 if it does not leave it.
  HWY_INLINE V leave(V u) {
    const V up = hn::GatherIndex(d_, upper_.data(), interval_);
    const V down = hn::GatherIndex(d_, lower_.data(), interval_);
    exit_ = hn::IfThenElse(rising_, up, down);
    const M ends_inside =
        hn::Or(hn::And(rising_, hn::Le(end_, up)), hn::AndNot(rising_, hn::Ge(end_, down)));
    const V one = hn::Set(d_, 1.0);
    const V at = hn::Mul(hn::Sub(exit_, begin_), inverse_);
    leave_ = hn::IfThenElse(ends_inside, one, hn::Min(hn::Max(at, u), one));
    exit_ = hn::IfThenElse(ends_inside, end_, exit_);
    return leave_;
  }

  // Returns the scalar at u, which is at or before the result of `leave`; exact both at the
  // segment's end and at a breakpoint.
  HWY_INLINE V scalar_at(V u) const {
    return hn::IfThenElse(hn::Ge(u, leave_), exit_, hn::MulAdd(difference_, u, begin_));
  }
  HWY_INLINE void advance(V u, V scalar, M active) {
    now_ = hn::IfThenElse(active, scalar, now_);
    const M left = hn::And(hn::And(active, hn::Ge(u, leave_)), hn::Ne(scalar, end_));
    const auto step =
        hn::IfThenElse(hn::RebindMask(DI(), rising_), hn::Set(DI(), 1), hn::Set(DI(), -1));
    interval_ = hn::Add(interval_, hn::IfThenElseZero(hn::RebindMask(DI(), left), step));
  }

 private:
  D d_;
  const std::vector<double>&lower_, &upper_;
  V begin_, end_, difference_, inverse_, now_;
  V leave_{}, exit_{};
  hn::Vec<DI> interval_;
  M rising_;
};

// How a piece's weights are computed: the PieceRule, resolved at compile time for the inner loop.
// The weights of emission include the length. `Optics`: OpticsTables, or a part of it.
struct ExactChromaticity {
  template <class D, class Optics, class V>
  static HWY_INLINE PieceWeights<V> weights(D d, const Optics&, V, V b, V a) {
    return linear_piece_weights(d, b, a);
  }
};

struct ExactEmission {
  template <class D, class Optics, class V>
  static HWY_INLINE PieceWeights<V> weights(D d, const Optics&, V length, V b, V a) {
    const auto w = linear_piece_emission(d, b, a);
    return {w.transparency, hn::Mul(w.front, length), hn::Mul(w.back, length)};
  }
};

struct MeanChromaticity {
  template <class D, class V>
  static HWY_INLINE PieceWeights<V> weights(D d, const OpticsTables&, V, V b, V a) {
    return linear_piece_mean_color(d, b, a);
  }
};

// All other rules: OpticsTables is queried for every piece.
struct AnyRule {
  template <class D, class V>
  static HWY_INLINE PieceWeights<V> weights(D d, const OpticsTables& optics, V length, V b, V a) {
    constexpr std::size_t kLanes = hn::MaxLanes(d);
    HWY_ALIGN double front[kLanes], back[kLanes], zeta[kLanes];
    hn::Store(b, d, front);
    hn::Store(a, d, back);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k) {
      const LinearPieceWeights w = linear_piece_by_rule(
          optics.rule, optics.emission ? Glow::emission : Glow::chromaticity, front[k], back[k]);
      zeta[k] = w.transparency;
      front[k] = w.front;
      back[k] = w.back;
    }
    const V unit = optics.emission ? length : hn::Set(d, 1.0);
    return {hn::Load(d, zeta), hn::Mul(hn::Load(d, front), unit), hn::Mul(hn::Load(d, back), unit)};
  }
};

// Whether a product is rounded before it is added (twice), or fused with the addition (once).
enum class Rounding : bool { once, twice };

// Adds a piece behind `sum` in the lanes of a mask.
template <Rounding kRounding = Rounding::once, class V, class M>
HWY_INLINE void add_behind(const Radiance<V>& piece, M where, Radiance<V>& sum) {
  const V visible = hn::IfThenElseZero(where, sum.transparency);
  const auto add = [&](V light, V& to) HWY_ATTR {
    if constexpr (kRounding == Rounding::once)
      to = hn::MulAdd(visible, light, to);
    else
      to = hn::Add(to, hn::Mul(visible, light));
  };
  add(piece.red, sum.red);
  add(piece.green, sum.green);
  add(piece.blue, sum.blue);
  sum.transparency =
      hn::IfThenElse(where, hn::Mul(sum.transparency, piece.transparency), sum.transparency);
}

// One channel of the radiance of a piece on which both fields stay within one interval of their
// tables. The colours at both ends are value + slope (scalar - anchor), so that their sum with the
// weights w is value (w_front + w_back) + slope (w_front (front - anchor) + w_back (back -
// anchor)).
template <class D, class Optics, class Interval, class V = hn::Vec<D>>
HWY_INLINE V color_channel(D d, const Optics& optics, const Interval& interval, std::size_t c,
                           V constant, V linear) {
  return hn::MulAdd(interval(d, optics.color.slope[c]), linear,
                    hn::Mul(interval(d, optics.color.value[c]), constant));
}

// The optical depth that a piece would have if its extinction were constant, with its value at
// `scalar`.
template <class D, class Optics, class Interval, class V = hn::Vec<D>>
HWY_INLINE V optical_density(D d, const Optics& optics, const Interval& interval, V scalar,
                             V length) {
  return hn::Mul(hn::Max(value_in(d, interval, optics.extinction, 0, scalar), hn::Zero(d)), length);
}

template <class Rule, class D, class Optics, class Interval, class V = hn::Vec<D>>
HWY_INLINE Radiance<V> piece_radiance(D d, const Optics& optics, const Interval& color,
                                      const Interval& extinction, V length, V front_color,
                                      V back_color, V front_extinction, V back_extinction) {
  const V b = optical_density(d, optics, extinction, front_extinction, length);
  const V a = optical_density(d, optics, extinction, back_extinction, length);
  const PieceWeights<V> w = Rule::weights(d, optics, length, b, a);
  const V anchor = color(d, optics.color.anchor);
  const V constant = hn::Add(w.front, w.back);
  const V linear = hn::MulAdd(w.front, hn::Sub(front_color, anchor),
                              hn::Mul(w.back, hn::Sub(back_color, anchor)));
  return {color_channel(d, optics, color, 0, constant, linear),
          color_channel(d, optics, color, 1, constant, linear),
          color_channel(d, optics, color, 2, constant, linear), w.transparency};
}

// The radiance of a segment within one interval of both tables.
template <class Rule, class D, class V = hn::Vec<D>>
HWY_INLINE Radiance<V> uniform_radiance(D d, const OpticsTables& optics, std::size_t color_interval,
                                        std::size_t extinction_interval, V length, V front_color,
                                        V back_color, V front_extinction, V back_extinction) {
  return piece_radiance<Rule>(d, optics, UniformInterval<D>{color_interval},
                              UniformInterval<D>{extinction_interval}, length, front_color,
                              back_color, front_extinction, back_extinction);
}

// Adds the pieces of segments along which one scalar moves from `front` to `back`, interval by
// interval in the order in which it passes them: upwards, or with kRising false downwards. Every
// lane adds, for each interval, the part of its segment that lies in it.
template <bool kRising, class Rule, class D, class V = hn::Vec<D>>
HWY_INLINE void composite_intervals(D d, const OpticsTables& optics, IntervalRange range, V length,
                                    V front, V back, hn::Mask<D> active, Radiance<V>& sum) {
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const V inverse = hn::Div(one, hn::Sub(back, front));
  V u = zero, now = front;
  for (std::size_t step = 0; step <= range.high - range.low; ++step) {
    const std::size_t k = kRising ? range.low + step : range.high - step;
    const V exit = hn::Set(d, kRising ? optics.extinction.upper[k] : optics.extinction.lower[k]);
    const auto ends_inside = kRising ? hn::Le(back, exit) : hn::Ge(back, exit);
    const auto started = kRising ? hn::Gt(exit, front) : hn::Lt(exit, front);
    const auto here = hn::And(active, started);
    const V next_u = hn::IfThenElse(
        ends_inside, one, hn::Min(hn::Max(hn::Mul(hn::Sub(exit, front), inverse), u), one));
    const V next = hn::IfThenElse(ends_inside, back, exit);
    if (!hn::AllFalse(d, here)) {
      add_behind(uniform_radiance<Rule>(d, optics, k, k, hn::Mul(length, hn::Sub(next_u, u)), now,
                                        next, now, next),
                 here, sum);
      u = hn::IfThenElse(here, next_u, u);
      now = hn::IfThenElse(here, next, now);
      active = hn::AndNot(hn::And(here, ends_inside), active);
      if (hn::AllFalse(d, active)) return;
    }
  }
}

// Whether all active lanes stay within one interval of a table; if so, `range` becomes that
// interval alone.
template <std::size_t N, class D, class V = hn::Vec<D>>
HWY_INLINE bool within_one_interval(D d, const TransferTable<N>& table, V front, V back,
                                    hn::Mask<D> active, IntervalRange& range) {
  const V least = hn::Min(front, back), most = hn::Max(front, back);
  for (std::size_t k = range.low; k <= range.high; ++k) {
    const V lower = hn::Set(d, table.lower[k]), upper = hn::Set(d, table.upper[k]);
    // a breakpoint itself belongs to the interval above it
    const auto outside =
        hn::Or(hn::Lt(least, lower), hn::Or(hn::Gt(most, upper), hn::Ge(least, upper)));
    if (!hn::AllFalse(d, hn::And(active, outside))) continue;
    range = {k, k};
    return true;
  }
  return false;
}

// The radiance of a segment that is cut at every breakpoint that its scalar passes; colour and
// extinction depend on the same field. Neighbouring rays pass the same breakpoints: all lanes share
// the intervals, so that no gather is needed.
template <class Rule, class D, class V = hn::Vec<D>>
HWY_INLINE Radiance<V> sliced_radiance(D d, const OpticsTables& optics, IntervalRange range,
                                       V length, V front, V back, hn::Mask<D> active) {
  Radiance<V> sum{hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Set(d, 1.0)};
  const auto rising = hn::Ge(back, front);
  const auto up = hn::And(active, rising), down = hn::AndNot(rising, active);
  if (!hn::AllFalse(d, up))
    composite_intervals<true, Rule>(d, optics, range, length, front, back, up, sum);
  if (!hn::AllFalse(d, down))
    composite_intervals<false, Rule>(d, optics, range, length, front, back, down, sum);
  return sum;
}

// The radiance of a segment that is cut along the ray at every breakpoint of either table that its
// two scalars pass, lane by lane. Only the `active` lanes are followed.
template <class Rule, class D, class V = hn::Vec<D>>
HWY_INLINE Radiance<V> walked_radiance(D d, const OpticsTables& optics, IntervalRange color_range,
                                       IntervalRange extinction_range, V length, V front_color,
                                       V back_color, V front_extinction, V back_extinction,
                                       hn::Mask<D> active) {
  ScalarWalk<D> color(d, optics.color, color_range, front_color, back_color);
  ScalarWalk<D> extinction(d, optics.extinction, extinction_range, front_extinction,
                           back_extinction);
  const V one = hn::Set(d, 1.0);
  Radiance<V> sum{hn::Zero(d), hn::Zero(d), hn::Zero(d), one};
  V u = hn::Zero(d);
  while (!hn::AllFalse(d, active)) {
    const V next = hn::Min(color.leave(u), extinction.leave(u));
    const V next_color = color.scalar_at(next), next_extinction = extinction.scalar_at(next);
    add_behind(piece_radiance<Rule>(d, optics, color.intervals(), extinction.intervals(),
                                    hn::Mul(length, hn::Sub(next, u)), color.now(), next_color,
                                    extinction.now(), next_extinction),
               active, sum);
    color.advance(next, next_color, active);
    extinction.advance(next, next_extinction, active);
    active = hn::And(active, hn::Lt(next, one));
    u = next;
  }
  return sum;
}

// The interval of each lane's scalar, which lies in one of `range`.
template <std::size_t N, class D, class V = hn::Vec<D>>
HWY_INLINE LaneIntervals<D> intervals_at(D d, const TransferTable<N>& table, IntervalRange range,
                                         V scalar) {
  const hn::RebindToSigned<D> di;
  auto interval = hn::Set(di, static_cast<std::int64_t>(range.low));
  for (std::size_t k = range.low; k < range.high; ++k) {
    const auto passed = hn::Ge(scalar, hn::Set(d, table.upper[k]));
    interval = hn::Sub(interval, hn::VecFromMask(di, hn::RebindMask(di, passed)));
  }
  return {interval};
}

// The radiance of a segment that is not cut: colour and extinction are taken as linear between
// their values at its ends.
template <class Rule, class D, class V = hn::Vec<D>>
HWY_INLINE Radiance<V> unsliced_radiance(D d, const OpticsTables& optics, IntervalRange color_range,
                                         IntervalRange extinction_range, V length, V front_color,
                                         V back_color, V front_extinction, V back_extinction) {
  const auto color0 = intervals_at(d, optics.color, color_range, front_color);
  const auto color1 = intervals_at(d, optics.color, color_range, back_color);
  const auto tau0 = intervals_at(d, optics.extinction, extinction_range, front_extinction);
  const auto tau1 = intervals_at(d, optics.extinction, extinction_range, back_extinction);
  const PieceWeights<V> w =
      Rule::weights(d, optics, length, optical_density(d, optics, tau0, front_extinction, length),
                    optical_density(d, optics, tau1, back_extinction, length));
  const auto channel = [&](std::size_t c) {
    return hn::MulAdd(w.front, value_in(d, color0, optics.color, c, front_color),
                      hn::Mul(w.back, value_in(d, color1, optics.color, c, back_color)));
  };
  return {channel(0), channel(1), channel(2), w.transparency};
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
