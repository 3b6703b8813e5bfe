// Light of pieces on which transfer functions are so steep that rounding of the fields may give
// arbitrary values, compiled once for every instruction set. Include from a file that Highway's
// foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_LIGHT_BETWEEN_ENDS_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_LIGHT_BETWEEN_ENDS_INL
#    undef HIAC_RENDER_LIGHT_BETWEEN_ENDS_INL
#  else
#    define HIAC_RENDER_LIGHT_BETWEEN_ENDS_INL
#  endif

#  include <hwy/highway.h>

#  include "hiac/render/integrate/shading-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A piece between two breakpoints: the fields at its ends, the intervals of its transfer functions
// and its length in the world.
template <class D>
struct PieceEnds {
  using V = hn::Vec<D>;
  const IntervalReader<D>&color, &extinction;
  V front_color, back_color, front_extinction, back_extinction;
  V length;
};

// The table's function at a scalar, which is clamped to its interval; the result is clamped to [0,
// most].
template <std::size_t N, class D, class V = hn::Vec<D>>
HWY_INLINE V kept_value(D d, const IntervalReader<D>& interval, const TransferTable<N>& table,
                        std::size_t c, V scalar, double most) {
  const V anchor = interval(table.anchor);
  const V lower = interval(table.lower), upper = interval(table.upper);
  scalar = hn::IfThenElse(hn::IsFinite(scalar), scalar, anchor);
  scalar = hn::Min(hn::Max(scalar, lower), upper);
  const V value =
      hn::MulAdd(interval(table.slope[c]), hn::Sub(scalar, anchor), interval(table.value[c]));
  return hn::Min(hn::Max(value, hn::Zero(d)), hn::Set(d, most));
}

// Light of a piece whose extinction and colour run linearly from end to end.
template <bool kEmission, class D, class V = hn::Vec<D>>
HWY_NOINLINE Radiance<V> light_between_ends(D d, const OpticsTables& optics,
                                            const PieceEnds<D>& ends) {
  const auto density = [&](V scalar) HWY_ATTR {
    return hn::Mul(
        kept_value(d, ends.extinction, optics.extinction, 0, scalar, hwy::HighestValue<double>()),
        ends.length);
  };
  const V b = density(ends.front_extinction), a = density(ends.back_extinction);
  PieceWeights<V> w;
  if constexpr (kEmission) {
    w = linear_piece_emission(d, b, a);
    w.front = hn::Mul(w.front, ends.length);
    w.back = hn::Mul(w.back, ends.length);
  } else {
    w = linear_piece_weights(d, b, a);
  }
  const auto channel = [&](std::size_t c) HWY_ATTR {
    const V front =
        kept_value(d, ends.color, optics.color, c, ends.front_color, optics.largest_color);
    const V back =
        kept_value(d, ends.color, optics.color, c, ends.back_color, optics.largest_color);
    return hn::MulAdd(front, w.front, hn::Mul(back, w.back));
  };
  return {channel(0), channel(1), channel(2), w.transparency};
}

// Returns `light` in the lanes where its values are possible for the piece, elsewhere the result of
// light_between_ends. Needed where transfer functions are steep (OpticsTables::steep).
template <bool kEmission, class D, class V = hn::Vec<D>>
HWY_NOINLINE Radiance<V> sound_light(D d, const OpticsTables& optics, const Radiance<V>& light,
                                     const PieceEnds<D>& ends) {
  V limit = hn::Set(d, 2 * optics.largest_color);
  if constexpr (kEmission) limit = hn::Mul(limit, ends.length);
  const auto within = [&](V channel) HWY_ATTR { return hn::Le(hn::Abs(channel), limit); };
  const auto sound =
      hn::And(hn::And(hn::And(within(light.red), within(light.green)), within(light.blue)),
              hn::And(hn::Ge(light.transparency, hn::Zero(d)),
                      hn::Le(light.transparency, hn::Set(d, 1 + 0x1p-20))));
  if (hn::AllTrue(d, sound)) return light;
  const Radiance<V> other = light_between_ends<kEmission>(d, optics, ends);
  return {hn::IfThenElse(sound, light.red, other.red),
          hn::IfThenElse(sound, light.green, other.green),
          hn::IfThenElse(sound, light.blue, other.blue),
          hn::IfThenElse(sound, light.transparency, other.transparency)};
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
