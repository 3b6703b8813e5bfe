// Transfer functions on pieces of ray segments along which fields are polynomials, compiled once
// for every instruction set. Include from a file that Highway's foreach_target.h compiles
// repeatedly.

#if defined(HIAC_RENDER_PIECE_OPTICS_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_PIECE_OPTICS_INL
#    undef HIAC_RENDER_PIECE_OPTICS_INL
#  else
#    define HIAC_RENDER_PIECE_OPTICS_INL
#  endif

#  include <cstddef>
#  include <cstdint>

#  include <hwy/highway.h>

#  include "hiac/frame/interval_range.hpp"
#  include "hiac/frame/transfer_table.hpp"
#  include "hiac/render/integrate/shading-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Reads a transfer function in the intervals in which a field is in the middle of pieces; those of
// neighbouring rays are mostly one. `range`: the intervals that may be met; `middle`: the field
// less `base`.
template <std::size_t N, class D, class V = hn::Vec<D>>
HWY_INLINE IntervalReader<D> reader_at_middle(D d, const TransferTable<N>& table,
                                              IntervalRange range, double base, V middle) {
  if (range.low == range.high) return IntervalReader<D>(d, range.low);
  const hn::RebindToSigned<D> di;
  auto interval = hn::Set(di, static_cast<std::int64_t>(range.low));
  for (std::size_t k = range.low; k < range.high; ++k) {
    const auto passed = hn::Ge(middle, hn::Set(d, table.upper[k] - base));
    interval = hn::Sub(interval, hn::VecFromMask(di, hn::RebindMask(di, passed)));
  }
  const std::int64_t first = hn::GetLane(interval);
  if (hn::AllTrue(di, hn::Eq(interval, hn::Set(di, first))))
    return IntervalReader<D>(d, static_cast<std::size_t>(first));
  return IntervalReader<D>(d, interval);
}

// The transfer function of extinction on a piece: offset + slope f, f less the base.
template <class V>
struct PieceExtinction {
  V offset, slope;
};
template <class D, class V = hn::Vec<D>>
HWY_INLINE PieceExtinction<V> extinction_on_piece(D d, const OpticsTables& optics,
                                                  const IntervalReader<D>& reader, double base) {
  const V slope = reader(optics.extinction.slope[0]);
  const V anchor = hn::Sub(reader(optics.extinction.anchor), hn::Set(d, base));
  return {hn::NegMulAdd(slope, anchor, reader(optics.extinction.value[0])), slope};
}

// The transfer function of colour on a piece: value + slope (f - anchor), f less the base.
template <class V>
struct PieceColor {
  V anchor, value[3], slope[3];
};
template <class D, class V = hn::Vec<D>>
HWY_INLINE PieceColor<V> color_on_piece(D d, const OpticsTables& optics,
                                        const IntervalReader<D>& reader, double base) {
  PieceColor<V> c;
  c.anchor = hn::Sub(reader(optics.color.anchor), hn::Set(d, base));
  for (std::size_t k = 0; k < 3; ++k) {
    c.value[k] = reader(optics.color.value[k]);
    c.slope[k] = reader(optics.color.slope[k]);
  }
  return c;
}

// The largest magnitude of three channels.
template <class V>
HWY_INLINE V largest(const V (&v)[3]) {
  return hn::Max(hn::Max(hn::Abs(v[0]), hn::Abs(v[1])), hn::Abs(v[2]));
}

// Means over a piece: of exp(-A), which emission needs, and of exp(-A) times a factor.
template <class V>
struct PieceMeans {
  V of_one, of_factor;
};

// Adds a piece behind what is in `sum`; a channel is value * constant + slope * linear.
template <class M, class V>
HWY_INLINE void add_piece_behind(const PieceColor<V>& color, V constant, V linear, V zeta, M active,
                                 Radiance<V>& sum) {
  const auto channel = [&](std::size_t c) HWY_ATTR {
    return hn::MulAdd(color.slope[c], linear, hn::Mul(color.value[c], constant));
  };
  add_behind(Radiance<V>{channel(0), channel(1), channel(2), zeta}, active, sum);
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
