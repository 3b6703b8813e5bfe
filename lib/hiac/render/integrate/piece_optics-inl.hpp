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
#  include "hiac/render/integrate/light_between_ends-inl.hpp"
#  include "hiac/render/integrate/rule_choice-inl.hpp"
#  include "hiac/render/integrate/shading-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A field in the current cell, as used by a walk along segments. Polynomials represent the field
// minus `base`.
struct WalkField {
  IntervalRange intervals;  // of its transfer function, in the cell
  double base;
  double spread = 0;  // bound of |field - base|; only some walks need it
};

// Returns a reader of a transfer function at the intervals that contain the field's values in the
// middle of pieces; usually all lanes have the same interval. `range`: the possible intervals;
// `middle`: the field minus `base` in the middle.
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

// The transfer function of extinction on a piece: offset + slope f, with f the field minus its
// base.
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

// The transfer function of colour on a piece: value + slope (f - anchor), with f the field minus
// its base.
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

// The optical depth along a piece, sum of alpha_k z^k, and its value at the end.
template <class V, std::size_t kDegree>
struct PieceDepth {
  V alpha[kDegree + 2];
  V total;
};

// The optical depth for an extinction offset + slope f, with f the polynomial of coefficients c.
template <std::size_t kDegree, class D, class V = hn::Vec<D>>
HWY_INLINE PieceDepth<V, kDegree> depth_of(D d, const V* c, V offset, V slope, V length) {
  PieceDepth<V, kDegree> depth;
  const V scale = hn::Mul(hn::Set(d, 0.5), length);
  slope = hn::Mul(slope, scale);
  V odd = hn::MulAdd(slope, c[0], hn::Mul(offset, scale)), even = hn::Zero(d);
  depth.alpha[1] = odd;
  for (std::size_t k = 1; k <= kDegree; ++k) {
    const V alpha = hn::Mul(hn::Mul(slope, c[k]), hn::Set(d, 1 / static_cast<double>(k + 1)));
    depth.alpha[k + 1] = alpha;
    (k % 2 == 0 ? odd : even) = hn::Add(k % 2 == 0 ? odd : even, alpha);
  }
  // the depth is 0 at the front
  depth.alpha[0] = hn::Sub(odd, even);
  depth.total = hn::Max(hn::Add(odd, odd), hn::Zero(d));
  return depth;
}

// The number of nodes that gives the mean of p exp(-A) with an error of at most 1 / weight in all
// lanes, where p, the `factor`, is kappa' or g. 0 if no rule has enough nodes.
template <bool kEmission, std::size_t kFactor, std::size_t kDegree, class D, class V = hn::Vec<D>>
HWY_INLINE std::size_t nodes_for(D d, const BernsteinEllipses& ellipses,
                                 const PieceDepth<V, kDegree>& depth, const V* factor,
                                 const PieceColor<V>& color, V weight, hn::Mask<D> active,
                                 EllipseChoice& ellipse) {
  FactorBound<V, kFactor> bound;
  for (std::size_t k = 0; k <= kFactor; ++k) bound.size[k] = hn::Abs(factor[k]);
  bound.brightest = kEmission ? hn::Mul(weight, largest(color.value)) : hn::Zero(d);
  bound.steepness = hn::Mul(weight, largest(color.slope));
  return nodes_needed<kDegree + 1, kFactor>(d, ellipses, depth.alpha, bound, active, ellipse);
}

// The value of a field of the given degree at an end of a piece, z = -1 or 1.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V end_of(D d, const V* c, std::size_t degree, double z, double base) {
  V value = c[degree];
  for (std::size_t k = degree; k-- > 0;) value = hn::MulAdd(value, hn::Set(d, z), c[k]);
  return hn::Add(value, hn::Set(d, base));
}

// The light of a piece whose channels are value * constant + slope * linear.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Radiance<V> light_of(D, const PieceColor<V>& color, V constant, V linear, V zeta) {
  const auto channel = [&](std::size_t c) HWY_ATTR {
    return hn::MulAdd(color.slope[c], linear, hn::Mul(color.value[c], constant));
  };
  return {channel(0), channel(1), channel(2), zeta};
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
