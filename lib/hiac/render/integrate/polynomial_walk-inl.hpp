// Radiance of ray segments along which fields are polynomials, compiled once for every instruction
// set. Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_POLYNOMIAL_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_POLYNOMIAL_WALK_INL
#    undef HIAC_RENDER_POLYNOMIAL_WALK_INL
#  else
#    define HIAC_RENDER_POLYNOMIAL_WALK_INL
#  endif

#  include <algorithm>
#  include <array>
#  include <cmath>
#  include <vector>

#  include <hwy/highway.h>

#  include "hiac/element/lane_polynomial-inl.hpp"
#  include "hiac/render/integrate/light_between_ends-inl.hpp"
#  include "hiac/render/integrate/piece_optics-inl.hpp"
#  include "hiac/render/integrate/rule_choice-inl.hpp"
#  include "hiac/render/integrate/shading-inl.hpp"
#  include "hiac/render/integrate/symmetric_rules.hpp"
#  include "hiac/render/integrate/transparency-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A field in the cell at hand, as a walk sees it. Polynomials are of the field less `base`.
struct WalkField {
  IntervalRange intervals;  // of its transfer function, in the cell
  double base;
  double spread;  // not less than any magnitude of the field less base
};

// Integrates segments piece by piece, front to back.
//
// A piece ends where a field takes a value at which its transfer function bends or jumps. A
// polynomial whose slope at 0 outweighs what higher powers add to it rises, or falls, and takes it
// once, and Newton's method finds where; others are halved until they do not meet it or are
// monotone. On a piece, z from -1 to 1, extinction and colour are polynomials, and so is the
// optical depth A. With chromaticity, integration by parts leaves
//     I = kappa(-1) - kappa(1) exp(-A(1)) + integral of kappa' exp(-A),
// with emission I = length times the mean of g exp(-A). The integrals are Gauss-Legendre sums with
// as many nodes as the bound of symmetric_rules.hpp asks for, or pieces are halved.
template <bool kEmission>
class PolynomialWalk {
 public:
  // `color` counts where the fields are two.
  PolynomialWalk(const OpticsTables& optics, const WalkField& color, const WalkField& extinction)
      : optics_(optics),
        color_(color),
        extinction_(extinction),
        never_cut_(extinction.intervals.low == extinction.intervals.high &&
                   (optics.same_field || color.intervals.low == color.intervals.high)),
        rules_(symmetric_rules()),
        ellipses_(bernstein_ellipses()) {}

  // Adds segments behind what is in `sum`. `length`: of z from -1 to 1, in the world; `allowed`:
  // absolute error that may be made on it, over the transparency in front of `sum`. Lanes that are
  // active must have finite numbers, and those that are not, too. Returns the lanes that could not
  // be done. Polynomials come to have zeros behind their last coefficients.
  template <class D, class V = hn::Vec<D>>
  HWY_NOINLINE hn::Mask<D> add(D d, LanePolynomial<V>& extinction, LanePolynomial<V>& color,
                               V length, V allowed, hn::Mask<D> active, Radiance<V>& sum) {
    const V one = hn::Set(d, 1.0), half = hn::Set(d, 0.5), narrow = hn::Set(d, kNarrow);
    const std::size_t top =
        top_for(optics_.same_field ? extinction.degree : std::max(extinction.degree, color.degree));
    pad(d, extinction, top);
    if (!optics_.same_field) pad(d, color, top);
    V u = hn::Set(d, -1.0), v = one;
    Fields<V> f;
    f.extinction.now = &extinction;
    f.color.now = &color;
    bool settled = never_cut_;  // no breakpoint is left between u and v
    for (int round = 0; round < kMostRounds; ++round) {
      if (hn::AllFalse(d, active)) return active;
      V part = hn::Mul(half, hn::Sub(v, u));
      if (!settled) {
        V end = one;
        settled = find_end(d, f, hn::And(active, hn::Gt(part, narrow)), end);
        if (!hn::AllTrue(d, hn::Eq(end, one))) part = shorten(d, end, top, f, u, v);
        if (!settled) continue;
      }
      const bool may_refuse = hn::AllTrue(d, hn::Or(hn::Not(active), hn::Gt(part, narrow)));
      const LanePolynomial<V>& tau_field = *f.extinction.now;
      const LanePolynomial<V>& field = optics_.same_field ? tau_field : *f.color.now;
      const V piece = hn::Mul(length, part), piece_allowed = hn::Mul(allowed, part);
      const bool added = with_top(top, [&]<std::size_t kTop>() {
        return add_piece<kTop>(d, tau_field, field, piece, piece_allowed, active, may_refuse, sum);
      });
      if (!added) {
        shorten(d, hn::Zero(d), top, f, u, v);
        continue;
      }
      u = v;
      v = one;
      settled = never_cut_;
      // what is behind this adds less than rounding
      active = hn::And(active,
                       hn::And(hn::Lt(u, one), hn::Gt(sum.transparency, hn::Set(d, kInvisible))));
      if (hn::AllFalse(d, active)) return active;
      f.extinction.now = &extinction;
      f.color.now = &color;
      keep(d, top, hn::Mul(half, hn::Add(one, u)), hn::Mul(half, hn::Sub(one, u)), f);
    }
    return active;
  }

 private:
  static constexpr int kMostRounds = 1000;
  static constexpr double kNarrow = 0x1p-40;  // breakpoints in shorter pieces do not count
  static constexpr double kInvisible = 1e-20;

  // A field between u and v, on [-1, 1]: the whole segment's, which mostly is not cut, or a part.
  template <class V>
  struct Between {
    const LanePolynomial<V>* now;
    LanePolynomial<V> part;
  };
  template <class V>
  struct Fields {
    Between<V> extinction, color;
  };

  // Keeps what is in [middle - half, middle + half] of them.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE void keep(D d, std::size_t top, V middle, V half, Fields<V>& f) const {
    const auto keep_of = [&](Between<V>& field) HWY_ATTR {
      if (field.now != &field.part) {
        field.part.degree = field.now->degree;
        for (std::size_t k = 0; k <= 2 * top; ++k) field.part.c[k] = field.now->c[k];
        field.now = &field.part;
      }
      keep_part(d, field.part, middle, half);
    };
    keep_of(f.extinction);
    if (!optics_.same_field) keep_of(f.color);
  }

  // Keeps what is in front of `end`, or as much as a narrow piece has. Returns what part of the
  // whole that is.
  template <class D, class V = hn::Vec<D>>
  HWY_NOINLINE V shorten(D d, V end, std::size_t top, Fields<V>& f, V u, V& v) const {
    const V one = hn::Set(d, 1.0), half = hn::Set(d, 0.5), width = hn::Sub(v, u);
    V part = hn::MulAdd(half, end, half);
    part = hn::Max(part, hn::Min(hn::Div(hn::Set(d, kNarrow), width), one));
    v = hn::IfThenElse(hn::Eq(part, one), v, hn::MulAdd(width, part, u));
    keep(d, top, hn::Sub(part, one), part, f);
    return hn::Mul(half, hn::Sub(v, u));
  }

  // Where to end pieces of which `wide` lanes may meet a breakpoint: at the first one if it is
  // known, or halfway; at 1 the others. False where pieces may meet a breakpoint before that.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE bool find_end(D d, const Fields<V>& f, hn::Mask<D> wide, V& end) const {
    bool settled = cut_at(d, *f.extinction.now, optics_.extinction.upper, extinction_, wide, end);
    if (!optics_.same_field)
      settled = cut_at(d, *f.color.now, optics_.color.upper, color_, wide, end) && settled;
    return settled;
  }

  template <class D, class V = hn::Vec<D>>
  static HWY_NOINLINE bool cut_at(D d, const LanePolynomial<V>& f, const std::vector<double>& upper,
                                  const WalkField& field, hn::Mask<D> wide, V& end) {
    const auto [low, high] = field.intervals;
    if (low == high || f.degree == 0) return true;
    // bounds, and where the field is monotone its values at the ends
    const V zero = hn::Zero(d);
    V even_least = f.c[0], even_most = f.c[0], even = f.c[0];
    V odd = f.c[1], odd_size = hn::Abs(f.c[1]), bend = zero;
    for (std::size_t k = 2; k <= f.degree; ++k) {
      const V size = hn::Abs(f.c[k]);
      bend = hn::MulAdd(hn::Set(d, kTwice[k]), size, bend);
      if (k % 2 == 0) {
        even = hn::Add(even, f.c[k]);
        even_least = hn::Add(even_least, hn::Min(f.c[k], zero));
        even_most = hn::Add(even_most, hn::Max(f.c[k], zero));
      } else {
        odd = hn::Add(odd, f.c[k]);
        odd_size = hn::Add(odd_size, size);
      }
    }
    const V front = hn::Sub(even, odd), back = hn::Add(even, odd);
    const auto monotone = hn::Ge(hn::Abs(hn::Add(f.c[1], f.c[1])), bend);
    const V least = hn::IfThenElse(monotone, hn::Min(front, back), hn::Sub(even_least, odd_size));
    const V most = hn::IfThenElse(monotone, hn::Max(front, back), hn::Add(even_most, odd_size));
    // a piece that ends at a breakpoint does so to within rounding
    const V doubt = hn::Set(d, 0x1p-46 * field.spread + 0x1p-51 * std::abs(field.base));
    auto meets = hn::Lt(hn::Set(d, 1.0), zero);
    for (std::size_t k = low; k < high; ++k) {
      const V value = hn::Set(d, upper[k] - field.base);
      meets = hn::Or(meets, hn::And(hn::Lt(least, hn::Sub(value, doubt)),
                                    hn::Gt(most, hn::Add(value, doubt))));
    }
    meets = hn::And(meets, wide);
    if (hn::AllFalse(d, meets)) return true;
    const auto once = hn::And(meets, monotone);
    if (hn::AllFalse(d, once)) {
      end = hn::IfThenElse(meets, hn::Min(end, zero), end);
      return false;
    }
    // the first that is met
    const auto rises = hn::Gt(f.c[1], zero);
    const V after = hn::Add(front, doubt), before = hn::Sub(front, doubt);
    V target = front;
    for (std::size_t k = low; k < high; ++k) {
      const V value = hn::Set(d, upper[k] - field.base);
      target = hn::IfThenElse(hn::AndNot(rises, hn::Lt(value, before)), value, target);
    }
    for (std::size_t k = high; k-- > low;) {
      const V value = hn::Set(d, upper[k] - field.base);
      target = hn::IfThenElse(hn::And(rises, hn::Gt(value, after)), value, target);
    }
    const V chord = hn::Div(hn::Sub(hn::Sub(target, front), odd), odd);
    const V stop = hn::IfThenElseZero(once, root(d, f, target, chord, once, rises));
    end = hn::IfThenElse(meets, hn::Min(end, stop), end);
    return hn::AllFalse(d, hn::AndNot(once, meets));
  }

  // Where monotone polynomials take values between those at their ends: Newton's method, kept
  // between bounds.
  template <class D, class V = hn::Vec<D>>
  static HWY_NOINLINE V root(D d, const LanePolynomial<V>& f, V target, V guess, hn::Mask<D> where,
                             hn::Mask<D> rises) {
    V low = hn::Set(d, -1.0), high = hn::Set(d, 1.0);
    V z = hn::IfThenElseZero(where, hn::Min(hn::Max(guess, low), high));
    for (int step = 0; step < 64; ++step) {
      V value = f.c[f.degree], slope = hn::Zero(d);
      for (std::size_t k = f.degree; k-- > 0;) {
        slope = hn::MulAdd(slope, z, value);
        value = hn::MulAdd(value, z, f.c[k]);
      }
      const V off = hn::Sub(value, target);
      const auto beyond = hn::Xor(rises, hn::Lt(off, hn::Zero(d)));
      high = hn::IfThenElse(beyond, z, high);
      low = hn::IfThenElse(beyond, low, z);
      V next = hn::Sub(z, hn::Div(off, slope));
      const auto inside = hn::And(hn::Ge(next, low), hn::Le(next, high));
      next = hn::IfThenElse(inside, next, hn::Mul(hn::Add(low, high), hn::Set(d, 0.5)));
      const V change = hn::Abs(hn::Sub(next, z));
      z = hn::IfThenElse(where, next, z);
      // the next step would be as short as this one squared
      if (hn::AllTrue(d, hn::Or(hn::Not(where), hn::Le(change, hn::Set(d, 0x1p-29))))) break;
    }
    return z;
  }

  // Pieces are compiled for fields of some degrees, 2 top, less than which is padded with zeros:
  // the optical depth has coefficients up to that of z^(2 top + 1).
  static constexpr std::size_t kMostTop = (kMaxFieldDegree + 1) / 2;

  // The least of the tops that pieces are compiled for, for some degree.
  static HWY_INLINE std::size_t top_for(std::size_t degree) {
    return degree < 3 ? 1 : (degree + 3) / 4 * 2;
  }
  template <class D, class V = hn::Vec<D>>
  static HWY_INLINE void pad(D d, LanePolynomial<V>& f, std::size_t top) {
    for (std::size_t k = f.degree + 1; k <= 2 * top; ++k) f.c[k] = hn::Zero(d);
  }
  template <class F>
  static HWY_INLINE auto with_top(std::size_t top, F&& f) {
    static_assert(kMostTop == 10);
    switch (top) {
      case 1:
        return f.template operator()<1>();
      case 2:
        return f.template operator()<2>();
      case 4:
        return f.template operator()<4>();
      case 6:
        return f.template operator()<6>();
      case 8:
        return f.template operator()<8>();
      default:
        return f.template operator()<10>();
    }
  }

  // The optical depth along a piece in powers of z, and at its end.
  template <std::size_t kTop, class V>
  struct Depth {
    V alpha[2 * kTop + 2];
    V total;
  };

  // Of an extinction offset + slope f.
  template <std::size_t kTop, class D, class V = hn::Vec<D>>
  static HWY_INLINE Depth<kTop, V> depth_of(D d, const LanePolynomial<V>& f, V offset, V slope,
                                            V length) {
    Depth<kTop, V> depth;
    const V scale = hn::Mul(hn::Set(d, 0.5), length);
    slope = hn::Mul(slope, scale);
    V odd = hn::MulAdd(slope, f.c[0], hn::Mul(offset, scale)), even = hn::Zero(d);
    depth.alpha[1] = odd;
    for (std::size_t k = 1; k <= 2 * kTop; ++k) {
      const V alpha = hn::Mul(hn::Mul(slope, f.c[k]), hn::Set(d, 1 / static_cast<double>(k + 1)));
      depth.alpha[k + 1] = alpha;
      (k % 2 == 0 ? odd : even) = hn::Add(k % 2 == 0 ? odd : even, alpha);
    }
    // no depth at the front
    depth.alpha[0] = hn::Sub(odd, even);
    depth.total = hn::Max(hn::Add(odd, odd), hn::Zero(d));
    return depth;
  }

  // What integrands have besides exp(-A): with emission the field less the anchor, else its
  // derivative over the length of a piece.
  template <std::size_t kTop>
  static constexpr std::size_t kFactorTop = kEmission ? kTop : kTop - 1;

  // False when no rule meets what is allowed and the piece `may_refuse`.
  template <std::size_t kTop, class D, class V = hn::Vec<D>>
  HWY_NOINLINE bool add_piece(D d, const LanePolynomial<V>& tau_field,
                              const LanePolynomial<V>& field, V length, V allowed,
                              hn::Mask<D> active, bool may_refuse, Radiance<V>& sum) {
    const auto extinction = reader_at_middle(d, optics_.extinction, extinction_.intervals,
                                             extinction_.base, tau_field.c[0]);
    const auto color = optics_.same_field ? extinction
                                          : reader_at_middle(d, optics_.color, color_.intervals,
                                                             color_.base, field.c[0]);
    const PieceColor<V> channels =
        color_on_piece(d, optics_, color, optics_.same_field ? extinction_.base : color_.base);
    const auto [offset, slope] = extinction_on_piece(d, optics_, extinction, extinction_.base);
    // nothing of what other lanes have may pass what numbers reach
    const Depth<kTop, V> depth =
        depth_of<kTop>(d, tau_field, offset, slope, hn::IfThenElseZero(active, length));
    V factor[2 * kFactorTop<kTop> + 2], front = hn::Sub(field.c[0], channels.anchor), back = front;
    factor[2 * kFactorTop<kTop> + 1] = hn::Zero(d);
    if constexpr (kEmission) {
      factor[0] = front;
      for (std::size_t k = 1; k <= 2 * kTop; ++k) factor[k] = field.c[k];
    } else {
      for (std::size_t k = 1; k <= 2 * kTop; ++k) {
        factor[k - 1] = hn::Mul(hn::Set(d, 2 * static_cast<double>(k)), field.c[k]);
        front = k % 2 == 0 ? hn::Add(front, field.c[k]) : hn::Sub(front, field.c[k]);
        back = hn::Add(back, field.c[k]);
      }
    }
    const V weight = hn::IfThenElseZero(active, hn::Div(sum.transparency, allowed));
    const std::size_t nodes = nodes_for<kTop>(d, depth, factor, channels, length, weight);
    if (nodes == 0 && may_refuse) return false;
    const SymmetricRule& rule = rules_[(nodes == 0 ? kMostSymmetricNodes : nodes) - 1];
    const Thickness thickness(
        hn::GetLane(hn::MaxOfLanes(d, hn::IfThenElseZero(active, depth.total))));
    const V zeta = transparency(d, depth.total, thickness);
    const PieceMeans<V> means = means_of<kTop>(d, rule, depth, thickness, factor);
    V constant, linear;  // a channel is value * constant + slope * linear
    if constexpr (kEmission) {
      constant = hn::Mul(means.of_one, length);
      linear = hn::Mul(means.of_factor, length);
    } else {
      constant = hn::Sub(hn::Set(d, 1.0), zeta);
      linear = hn::Add(hn::NegMulAdd(back, zeta, front), means.of_factor);
    }
    if (HWY_UNLIKELY(optics_.steep)) {
      const auto channel = [&](std::size_t c) {
        return hn::MulAdd(channels.slope[c], linear, hn::Mul(channels.value[c], constant));
      };
      Radiance<V> light{channel(0), channel(1), channel(2), zeta};
      const double color_base = optics_.same_field ? extinction_.base : color_.base;
      light =
          sound_light<kEmission>(d, optics_, light,
                                 PieceEnds<D>{color, extinction, end_of(d, field, -1.0, color_base),
                                              end_of(d, field, 1.0, color_base),
                                              end_of(d, tau_field, -1.0, extinction_.base),
                                              end_of(d, tau_field, 1.0, extinction_.base), length});
      add_behind(light, active, sum);
    } else {
      add_piece_behind(channels, constant, linear, zeta, active, sum);
    }
    return true;
  }

  // A field at an end of a piece, z = -1 or 1.
  template <class D, class V = hn::Vec<D>>
  static HWY_INLINE V end_of(D d, const LanePolynomial<V>& f, double z, double base) {
    V value = f.c[f.degree];
    for (std::size_t k = f.degree; k-- > 0;) value = hn::MulAdd(value, hn::Set(d, z), f.c[k]);
    return hn::Add(value, hn::Set(d, base));
  }

  // How many nodes give the mean of p exp(-A) with an error of at most 1 / weight, p being kappa'
  // or g: the best of some ellipses, for the lane that needs most. 0: more than there are.
  template <std::size_t kTop, class D, class V = hn::Vec<D>>
  HWY_NOINLINE std::size_t nodes_for(D d, const Depth<kTop, V>& depth, const V* factor,
                                     const PieceColor<V>& channels, V length, V weight) {
    constexpr std::size_t kDepth = 2 * kTop + 1,
                          kFactor = 2 * kFactorTop<kTop> + (kEmission ? 0 : 1);
    FactorBound<V, kFactor> bound;
    for (std::size_t k = 0; k <= kFactor; ++k) bound.size[k] = hn::Abs(factor[k]);
    bound.brightest = hn::Zero(d);
    if constexpr (kEmission) {
      weight = hn::Mul(weight, length);
      bound.brightest = hn::Mul(weight, largest(channels.value));
    }
    bound.steepness = hn::Mul(largest(channels.slope), weight);
    return nodes_needed<kDepth, kFactor>(d, ellipses_, depth.alpha, bound,
                                         hn::Gt(weight, hn::Zero(d)), ellipse_);
  }

  template <std::size_t kTop, class D, class V = hn::Vec<D>>
  static HWY_NOINLINE PieceMeans<V> means_of(D d, const SymmetricRule& rule,
                                             const Depth<kTop, V>& depth,
                                             const Thickness& thickness, const V* factor) {
    PieceMeans<V> means{hn::Zero(d), hn::Zero(d)};
    if (rule.middle != 0) {
      means.of_one = hn::Mul(hn::Set(d, rule.middle), transparency(d, depth.alpha[0], thickness));
      means.of_factor = hn::Mul(means.of_one, factor[0]);
    }
    for (std::size_t k = 0; k < rule.pairs; ++k) {
      const V z = hn::Set(d, rule.z[k]), square = hn::Mul(z, z);
      const EvenAndOdd<V> at = even_and_odd<kTop>(depth.alpha, square);
      V zeta[2] = {hn::NegMulAdd(z, at.odd, at.even), hn::MulAdd(z, at.odd, at.even)};
      replace_by_transparencies(d, zeta, thickness);
      const auto& [before, behind] = zeta;
      const V weight = hn::Set(d, rule.weight[k]);
      const V both = hn::Mul(weight, hn::Add(behind, before));
      const V apart = hn::Mul(hn::Mul(weight, z), hn::Sub(behind, before));
      const EvenAndOdd<V> f = even_and_odd<kFactorTop<kTop>>(factor, square);
      if constexpr (kEmission) means.of_one = hn::Add(means.of_one, both);
      means.of_factor = hn::MulAdd(f.even, both, hn::MulAdd(f.odd, apart, means.of_factor));
    }
    return means;
  }

  static constexpr auto kTwice = [] {  // numbers, from memory
    std::array<double, kMaxFieldDegree + 1> twice{};
    for (std::size_t k = 0; k < twice.size(); ++k) twice[k] = 2 * static_cast<double>(k);
    return twice;
  }();

  const OpticsTables& optics_;
  WalkField color_, extinction_;
  bool never_cut_;  // by breakpoints: there are none in the cell
  const SymmetricRules& rules_;
  const BernsteinEllipses& ellipses_;
  EllipseChoice ellipse_;
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
