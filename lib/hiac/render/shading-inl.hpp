// Radiance of ray segments through linear fields, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_SHADING_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_SHADING_INL
#    undef HIAC_RENDER_SHADING_INL
#  else
#    define HIAC_RENDER_SHADING_INL
#  endif

#  include <cstdint>

#  include <hwy/highway.h>

#  include "hiac/optics/linear_piece-inl.hpp"
#  include "hiac/render/transfer_table.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// What a ray segment adds to a pixel: light of its own, and the share of what is behind that it
// lets through.
template <class V>
struct Radiance {
  V red, green, blue, transparency;
};

// Intervals of a transfer function between which a cell's scalars lie.
struct IntervalRange {
  std::size_t low, high;
};

// Reads one column of a transfer table at every lane's interval; where the whole cell lies in one
// interval, without a gather.
template <class D>
class IntervalReader {
 public:
  using V = hn::Vec<D>;
  using Index = hn::Vec<hn::RebindToSigned<D>>;

  IntervalReader(D d, std::size_t uniform) : d_(d), uniform_(uniform), is_uniform_(true) {}
  IntervalReader(D d, Index lanes) : d_(d), lanes_(lanes), is_uniform_(false) {}

  HWY_INLINE V operator()(const std::vector<double>& column) const {
    return is_uniform_ ? hn::Set(d_, column[uniform_]) : hn::GatherIndex(d_, column.data(), lanes_);
  }
  // The table's function of channel c at the scalars of a piece's two ends.
  template <std::size_t N>
  HWY_INLINE void ends(const TransferTable<N>& table, std::size_t c, V front, V back, V& at_front,
                       V& at_back) const {
    const V anchor = (*this)(table.anchor), value = (*this)(table.value[c]);
    const V slope = (*this)(table.slope[c]);
    at_front = hn::MulAdd(slope, hn::Sub(front, anchor), value);
    at_back = hn::MulAdd(slope, hn::Sub(back, anchor), value);
  }

 private:
  D d_;
  Index lanes_{};
  std::size_t uniform_ = 0;
  bool is_uniform_;
};

// A scalar that runs linearly from `begin` (u = 0) to `end` (u = 1), met interval by interval.
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

  [[nodiscard]] HWY_INLINE IntervalReader<D> reader() const {
    return IntervalReader<D>(d_, interval_);
  }
  [[nodiscard]] HWY_INLINE V now() const { return now_; }

  // Finds where the present interval is left, not before u: 1 where it is not left any more.
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

  // Moves on to u, at or before what `leave` found, and returns the scalar there, exact at both
  // the segment's end and a breakpoint.
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

// How a piece's weights are found: PieceRule, as far as an inner loop must not ask about it. The
// weights of emission are times the length.
struct ExactChromaticity {
  template <class D, class V>
  static HWY_INLINE PieceWeights<V> weights(D d, const OpticsTables&, V, V b, V a) {
    return linear_piece_weights(d, b, a);
  }
};

struct ExactEmission {
  template <class D, class V>
  static HWY_INLINE PieceWeights<V> weights(D d, const OpticsTables&, V length, V b, V a) {
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

// The rest: what OpticsTables says, asked for every piece.
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

// One piece on which colour and extinction are linear, composited behind what is there (eq. 5 and
// its closed form: linear_piece-inl.hpp).
template <class Rule, class D, class V = hn::Vec<D>>
HWY_INLINE void composite_piece(D d, const OpticsTables& optics, V length, V tau_front, V tau_back,
                                const V (&front)[3], const V (&back)[3], hn::Mask<D> active,
                                Radiance<V>& sum) {
  const V zero = hn::Zero(d);
  const V b = hn::Mul(hn::Max(tau_front, zero), length);
  const V a = hn::Mul(hn::Max(tau_back, zero), length);
  const PieceWeights<V> weights = Rule::weights(d, optics, length, b, a);
  const V visible = hn::IfThenElseZero(active, sum.transparency);
  const V wf = hn::Mul(visible, weights.front), wb = hn::Mul(visible, weights.back);
  sum.red = hn::MulAdd(wf, front[0], hn::MulAdd(wb, back[0], sum.red));
  sum.green = hn::MulAdd(wf, front[1], hn::MulAdd(wb, back[1], sum.green));
  sum.blue = hn::MulAdd(wf, front[2], hn::MulAdd(wb, back[2], sum.blue));
  sum.transparency =
      hn::IfThenElse(active, hn::Mul(sum.transparency, weights.transparency), sum.transparency);
}

// A piece on which both fields stay within one interval of their tables, the same for all lanes.
template <class Rule, class D, class V = hn::Vec<D>>
HWY_INLINE void composite_interval_piece(D d, const OpticsTables& optics,
                                         std::size_t color_interval,
                                         std::size_t extinction_interval, V length, V front_color,
                                         V back_color, V front_extinction, V back_extinction,
                                         hn::Mask<D> active, Radiance<V>& sum) {
  const IntervalReader<D> color(d, color_interval), extinction(d, extinction_interval);
  V front[3], back[3], tau_front, tau_back;
  color.ends(optics.color, 0, front_color, back_color, front[0], back[0]);
  color.ends(optics.color, 1, front_color, back_color, front[1], back[1]);
  color.ends(optics.color, 2, front_color, back_color, front[2], back[2]);
  extinction.ends(optics.extinction, 0, front_extinction, back_extinction, tau_front, tau_back);
  composite_piece<Rule>(d, optics, length, tau_front, tau_back, front, back, active, sum);
}

// The segment lies within one interval of both tables.
template <class Rule, class D, class V = hn::Vec<D>>
HWY_INLINE Radiance<V> uniform_radiance(D d, const OpticsTables& optics, std::size_t color_interval,
                                        std::size_t extinction_interval, V length, V front_color,
                                        V back_color, V front_extinction, V back_extinction) {
  Radiance<V> sum{hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Set(d, 1.0)};
  composite_interval_piece<Rule>(d, optics, color_interval, extinction_interval, length,
                                 front_color, back_color, front_extinction, back_extinction,
                                 hn::Eq(length, length), sum);
  return sum;
}

// Adds the pieces of segments along which one scalar moves from `front` to `back`, interval by
// interval in the order in which it passes them: upwards, or with kRising false downwards. All
// lanes take part in every interval with whatever part of their segment lies in it.
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
      composite_interval_piece<Rule>(d, optics, k, k, hn::Mul(length, hn::Sub(next_u, u)), now,
                                     next, now, next, here, sum);
      u = hn::IfThenElse(here, next_u, u);
      now = hn::IfThenElse(here, next, now);
      active = hn::AndNot(hn::And(here, ends_inside), active);
      if (hn::AllFalse(d, active)) return;
    }
  }
}

// The segment is cut at every breakpoint that its scalar passes; colour and extinction depend on
// the same field. Neighbouring rays pass the same breakpoints: the intervals are common to all
// lanes, so that nothing is gathered.
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

// The segment is cut along the ray at every breakpoint of either table that its two scalars pass,
// lane by lane. `active` lanes alone are followed.
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
    V front[3], back[3], tau_front, tau_back;
    for (std::size_t c = 0; c < 3; ++c)
      color.reader().ends(optics.color, c, color.now(), next_color, front[c], back[c]);
    extinction.reader().ends(optics.extinction, 0, extinction.now(), next_extinction, tau_front,
                             tau_back);
    composite_piece<Rule>(d, optics, hn::Mul(length, hn::Sub(next, u)), tau_front, tau_back, front,
                          back, active, sum);
    color.advance(next, next_color, active);
    extinction.advance(next, next_extinction, active);
    active = hn::And(active, hn::Lt(next, one));
    u = next;
  }
  return sum;
}

// The interval of each lane's scalar, which lies in one of `range`.
template <std::size_t N, class D, class V = hn::Vec<D>>
HWY_INLINE IntervalReader<D> reader_at(D d, const TransferTable<N>& table, IntervalRange range,
                                       V scalar) {
  const hn::RebindToSigned<D> di;
  auto interval = hn::Set(di, static_cast<std::int64_t>(range.low));
  for (std::size_t k = range.low; k < range.high; ++k) {
    const auto passed = hn::Ge(scalar, hn::Set(d, table.upper[k]));
    interval = hn::Sub(interval, hn::VecFromMask(di, hn::RebindMask(di, passed)));
  }
  return IntervalReader<D>(d, interval);
}

// The segment is not cut: colour and extinction as if linear between their values at its ends.
template <class Rule, class D, class V = hn::Vec<D>>
HWY_INLINE Radiance<V> unsliced_radiance(D d, const OpticsTables& optics, IntervalRange color_range,
                                         IntervalRange extinction_range, V length, V front_color,
                                         V back_color, V front_extinction, V back_extinction) {
  Radiance<V> sum{hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Set(d, 1.0)};
  const auto color0 = reader_at(d, optics.color, color_range, front_color);
  const auto color1 = reader_at(d, optics.color, color_range, back_color);
  const auto tau0 = reader_at(d, optics.extinction, extinction_range, front_extinction);
  const auto tau1 = reader_at(d, optics.extinction, extinction_range, back_extinction);
  V front[3], back[3], tau_front, tau_back, other;
  for (std::size_t c = 0; c < 3; ++c) {
    color0.ends(optics.color, c, front_color, front_color, front[c], other);
    color1.ends(optics.color, c, back_color, back_color, back[c], other);
  }
  tau0.ends(optics.extinction, 0, front_extinction, front_extinction, tau_front, other);
  tau1.ends(optics.extinction, 0, back_extinction, back_extinction, tau_back, other);
  composite_piece<Rule>(d, optics, length, tau_front, tau_back, front, back, hn::Eq(length, length),
                        sum);
  return sum;
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
