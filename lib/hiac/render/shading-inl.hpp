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
  // The table's function of channel c at the scalars s.
  template <std::size_t N>
  HWY_INLINE V at(const TransferTable<N>& table, std::size_t c, V s) const {
    return hn::MulAdd((*this)(table.slope[c]), hn::Sub(s, (*this)(table.anchor)),
                      (*this)(table.value[c]));
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

// One piece on which colour and extinction are linear, composited behind what is there (eq. 5 and
// its closed form: linear_piece-inl.hpp).
template <bool kEmission, class D, class V = hn::Vec<D>>
HWY_INLINE void composite_piece(D d, V length, V tau_front, V tau_back, const V (&front)[3],
                                const V (&back)[3], hn::Mask<D> active, Radiance<V>& sum) {
  const V zero = hn::Zero(d);
  const V b = hn::Mul(hn::Max(tau_front, zero), length);
  const V a = hn::Mul(hn::Max(tau_back, zero), length);
  V front_weight, back_weight, zeta;
  if constexpr (kEmission) {
    const auto weights = linear_piece_emission(d, b, a);
    front_weight = hn::Mul(weights.front, length);
    back_weight = hn::Mul(weights.back, length);
    zeta = weights.transparency;
  } else {
    const auto weights = linear_piece_weights(d, b, a);
    front_weight = weights.front;
    back_weight = weights.back;
    zeta = weights.transparency;
  }
  const V visible = hn::IfThenElseZero(active, sum.transparency);
  const V wf = hn::Mul(visible, front_weight), wb = hn::Mul(visible, back_weight);
  sum.red = hn::MulAdd(wf, front[0], hn::MulAdd(wb, back[0], sum.red));
  sum.green = hn::MulAdd(wf, front[1], hn::MulAdd(wb, back[1], sum.green));
  sum.blue = hn::MulAdd(wf, front[2], hn::MulAdd(wb, back[2], sum.blue));
  sum.transparency = hn::IfThenElse(active, hn::Mul(sum.transparency, zeta), sum.transparency);
}

// The segment lies within one interval of both tables.
template <bool kEmission, class D, class V = hn::Vec<D>>
HWY_INLINE Radiance<V> uniform_radiance(D d, const OpticsTables& optics, std::size_t color_interval,
                                        std::size_t extinction_interval, V length, V front_color,
                                        V back_color, V front_extinction, V back_extinction) {
  const IntervalReader<D> color(d, color_interval), extinction(d, extinction_interval);
  V front[3], back[3];
  for (std::size_t c = 0; c < 3; ++c) {
    front[c] = color.at(optics.color, c, front_color);
    back[c] = color.at(optics.color, c, back_color);
  }
  Radiance<V> sum{hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Set(d, 1.0)};
  composite_piece<kEmission>(d, length, extinction.at(optics.extinction, 0, front_extinction),
                             extinction.at(optics.extinction, 0, back_extinction), front, back,
                             hn::Eq(length, length), sum);
  return sum;
}

// The segment is cut along the ray at every breakpoint of either table that its scalars pass.
// `active` lanes alone are followed.
template <bool kSeparateFields, bool kEmission, class D, class V = hn::Vec<D>>
HWY_INLINE Radiance<V> cut_radiance(D d, const OpticsTables& optics, IntervalRange color_range,
                                    IntervalRange extinction_range, V length, V front_color,
                                    V back_color, V front_extinction, V back_extinction,
                                    hn::Mask<D> active) {
  ScalarWalk<D> extinction(d, optics.extinction, extinction_range, front_extinction,
                           back_extinction);
  ScalarWalk<D> color = kSeparateFields
                            ? ScalarWalk<D>(d, optics.color, color_range, front_color, back_color)
                            : extinction;
  const V one = hn::Set(d, 1.0);
  Radiance<V> sum{hn::Zero(d), hn::Zero(d), hn::Zero(d), one};
  V u = hn::Zero(d);
  while (!hn::AllFalse(d, active)) {
    V next = extinction.leave(u);
    if constexpr (kSeparateFields) next = hn::Min(next, color.leave(u));
    const V extinction_next = extinction.scalar_at(next);
    const V color_next = kSeparateFields ? color.scalar_at(next) : extinction_next;
    const V color_now = kSeparateFields ? color.now() : extinction.now();
    const auto read_color = kSeparateFields ? color.reader() : extinction.reader();
    const auto read_extinction = extinction.reader();
    V front[3], back[3];
    for (std::size_t c = 0; c < 3; ++c) {
      front[c] = read_color.at(optics.color, c, color_now);
      back[c] = read_color.at(optics.color, c, color_next);
    }
    composite_piece<kEmission>(d, hn::Mul(length, hn::Sub(next, u)),
                               read_extinction.at(optics.extinction, 0, extinction.now()),
                               read_extinction.at(optics.extinction, 0, extinction_next), front,
                               back, active, sum);
    extinction.advance(next, extinction_next, active);
    if constexpr (kSeparateFields) color.advance(next, color_next, active);
    active = hn::And(active, hn::Lt(next, one));
    u = next;
  }
  return sum;
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
