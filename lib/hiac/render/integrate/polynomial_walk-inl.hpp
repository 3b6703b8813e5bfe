// Radiance of ray segments along which fields are polynomials, compiled once for every instruction
// set. Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_POLYNOMIAL_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_POLYNOMIAL_WALK_INL
#    undef HIAC_RENDER_POLYNOMIAL_WALK_INL
#  else
#    define HIAC_RENDER_POLYNOMIAL_WALK_INL
#  endif

#  include <algorithm>

#  include <hwy/highway.h>

#  include "hiac/element/lane_polynomial-inl.hpp"
#  include "hiac/render/integrate/piece_optics-inl.hpp"
#  include "hiac/render/integrate/polynomial_cuts-inl.hpp"
#  include "hiac/render/integrate/shading-inl.hpp"
#  include "hiac/render/integrate/symmetric_rules.hpp"
#  include "hiac/render/integrate/transparency-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Integrates segments piece by piece, front to back.
//
// A piece ends where a field takes a value at which its transfer function bends or jumps. A
// polynomial whose slope at 0 outweighs the contribution of higher powers is monotone and takes the
// value at most once; Newton's method finds where. Other pieces are halved until they do not take
// the value or are monotone. On a piece, z from -1 to 1, extinction and colour are polynomials, and
// so is the optical depth A. With chromaticity, integration by parts leaves
//     I = kappa(-1) - kappa(1) exp(-A(1)) + integral of kappa' exp(-A),
// with emission I = length times the mean of g exp(-A). The integrals are Gauss-Legendre sums whose
// number of nodes follows from the bound of symmetric_rules.hpp; a piece that needs too many is
// halved.
template <bool kEmission>
class PolynomialWalk {
 public:
  // `color` is used only if the two fields differ.
  PolynomialWalk(const OpticsTables& optics, const WalkField& color, const WalkField& extinction)
      : optics_(optics),
        color_(color),
        extinction_(extinction),
        never_cut_(extinction.intervals.low == extinction.intervals.high &&
                   (optics.same_field || color.intervals.low == color.intervals.high)),
        rules_(symmetric_rules()),
        ellipses_(bernstein_ellipses()) {}

  // Adds segments behind `sum` and returns the lanes that could not be done. `length`: world length
  // of z from -1 to 1; `allowed`: the absolute error allowed on it, divided by the transparency in
  // front of `sum`. All lanes, inactive ones too, must hold finite numbers. The polynomials are
  // padded with zeros.
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
      // the rest of the segment adds less than rounding
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
  static constexpr double kNarrow = 0x1p-40;  // breakpoints in shorter pieces are ignored
  static constexpr double kInvisible = 1e-20;

  // A field between u and v, mapped to [-1, 1]: that of the whole segment, which is rarely cut, or
  // a part.
  template <class V>
  struct Between {
    const LanePolynomial<V>* now;
    LanePolynomial<V> part;
  };
  template <class V>
  struct Fields {
    Between<V> extinction, color;
  };

  // Restricts the fields to [middle - half, middle + half].
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

  // Restricts the fields to the part in front of `end`, but not to less than a narrow piece.
  // Returns the fraction of the whole segment that remains.
  template <class D, class V = hn::Vec<D>>
  HWY_NOINLINE V shorten(D d, V end, std::size_t top, Fields<V>& f, V u, V& v) const {
    const V one = hn::Set(d, 1.0), half = hn::Set(d, 0.5), width = hn::Sub(v, u);
    V part = hn::MulAdd(half, end, half);
    part = hn::Max(part, hn::Min(hn::Div(hn::Set(d, kNarrow), width), one));
    v = hn::IfThenElse(hn::Eq(part, one), v, hn::MulAdd(width, part, u));
    keep(d, top, hn::Sub(part, one), part, f);
    return hn::Mul(half, hn::Sub(v, u));
  }

  // Lowers `end`, where to end pieces, in those of the `wide` lanes that may pass a breakpoint
  // (cut_at). Returns false if a piece may pass a breakpoint before its end.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE bool find_end(D d, const Fields<V>& f, hn::Mask<D> wide, V& end) const {
    bool settled = cut_at(d, *f.extinction.now, optics_.extinction.upper, extinction_, wide, end);
    if (!optics_.same_field)
      settled = cut_at(d, *f.color.now, optics_.color.upper, color_, wide, end) && settled;
    return settled;
  }

  // Pieces are compiled for fields of certain degrees 2 top; fields of lower degree are padded with
  // zeros. The optical depth has coefficients up to that of z^(2 top + 1).
  static constexpr std::size_t kMostTop = (kMaxFieldDegree + 1) / 2;

  // The smallest compiled `top` for a degree.
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

  // Half the degree of the integrand's factor beside exp(-A): with emission the field minus the
  // anchor, otherwise its derivative along the piece.
  template <std::size_t kTop>
  static constexpr std::size_t kFactorTop = kEmission ? kTop : kTop - 1;

  // Adds a piece. Returns false if no rule meets the allowed error and the function `may_refuse`.
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
    // length 0 in inactive lanes, so that nothing overflows there
    const PieceDepth<V, 2 * kTop> depth =
        depth_of<2 * kTop>(d, tau_field.c, offset, slope, hn::IfThenElseZero(active, length));
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
    const std::size_t nodes = nodes_of<kTop>(d, depth, factor, channels, length, weight);
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
    const auto ends = [&]() HWY_ATTR {
      const auto end = [&](const LanePolynomial<V>& f, double z, double base)
                           HWY_ATTR { return end_of(d, f.c, f.degree, z, base); };
      const double color_base = optics_.same_field ? extinction_.base : color_.base;
      return PieceEnds<D>{color,
                          extinction,
                          end(field, -1.0, color_base),
                          end(field, 1.0, color_base),
                          end(tau_field, -1.0, extinction_.base),
                          end(tau_field, 1.0, extinction_.base),
                          length};
    };
    Radiance<V> light = light_of(d, channels, constant, linear, zeta);
    if (HWY_UNLIKELY(optics_.steep)) {
      const Radiance<V> unchecked =
          light;  // what a function takes the address of is in no register
      light = sound_light<kEmission>(d, optics_, unchecked, ends());
    }
    add_behind(light, active, sum);
    return true;
  }

  // nodes_for of piece_optics-inl.hpp, not inlined.
  template <std::size_t kTop, class D, class V = hn::Vec<D>>
  HWY_NOINLINE std::size_t nodes_of(D d, const PieceDepth<V, 2 * kTop>& depth, const V* factor,
                                    const PieceColor<V>& channels, V length, V weight) {
    constexpr std::size_t kFactor = 2 * kFactorTop<kTop> + (kEmission ? 0 : 1);
    if constexpr (kEmission) weight = hn::Mul(weight, length);
    return nodes_for<kEmission, kFactor>(d, ellipses_, depth, factor, channels, weight,
                                         hn::Gt(weight, hn::Zero(d)), ellipse_);
  }

  template <std::size_t kTop, class D, class V = hn::Vec<D>>
  static HWY_NOINLINE PieceMeans<V> means_of(D d, const SymmetricRule& rule,
                                             const PieceDepth<V, 2 * kTop>& depth,
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

  const OpticsTables& optics_;
  WalkField color_, extinction_;
  bool never_cut_;  // no breakpoints in the cell
  const SymmetricRules& rules_;
  const BernsteinEllipses& ellipses_;
  EllipseChoice ellipse_;
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
