// Radiance of ray segments along which fields are quadratic or cubic, compiled once for every
// instruction set. Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_HIGHER_ORDER_SHADING_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_HIGHER_ORDER_SHADING_INL
#    undef HIAC_RENDER_HIGHER_ORDER_SHADING_INL
#  else
#    define HIAC_RENDER_HIGHER_ORDER_SHADING_INL
#  endif

#  include <vector>

#  include <hwy/highway.h>

#  include "hiac/render/integrate/piece_optics-inl.hpp"
#  include "hiac/render/integrate/polar_form-inl.hpp"
#  include "hiac/render/integrate/segment_cuts-inl.hpp"
#  include "hiac/render/integrate/shading-inl.hpp"
#  include "hiac/render/integrate/symmetric_rules.hpp"
#  include "hiac/render/integrate/transparency-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Segments of one vector of pixels, from z = `begin` to `end` in [-1, 1]. Unused lanes have length
// 0. Fields are relative to their bases.
template <class V, std::size_t kDegree>
struct HigherOrderSegments {
  BernsteinScalar<V, kDegree> color, extinction;  // equal if the fields are the same
  bool whole;                                     // all run from -1 to 1
  V begin, end;
  V length;  // world length of z from -1 to 1
  V weight;  // transparency in front / absolute error allowed for z from -1 to 1
};

// Integrates segments piece by piece, front to back.
//
// Segments are cut where a field takes a value at which its transfer function bends
// (segment_cuts-inl.hpp). On a piece, z from -1 to 1, extinction and colour are polynomials, and so
// is the optical depth A. With chromaticity, integration by parts leaves
//     I = kappa(-1) - kappa(1) exp(-A(1)) + integral of kappa' exp(-A),
// with emission I = length times the mean of g exp(-A). The integrals are Gauss-Legendre sums whose
// number of nodes follows from the bound of symmetric_rules.hpp; a piece that needs too many is
// halved.
template <bool kEmission, std::size_t kDegree>
class HigherOrderWalk {
 public:
  HigherOrderWalk(const OpticsTables& optics, const WalkField& color, const WalkField& extinction)
      : optics_(optics),
        color_(color),
        extinction_(extinction),
        rules_(symmetric_rules()),
        ellipses_(bernstein_ellipses()) {}

  template <class D, class V = hn::Vec<D>>
  HWY_INLINE Radiance<V> run(D d, const HigherOrderSegments<V, kDegree>& s, hn::Mask<D> active) {
    const V zero = hn::Zero(d), half = hn::Set(d, 0.5);
    Radiance<V> sum{zero, zero, zero, hn::Set(d, 1.0)};
    Piece<V> all;
    all.extinction = powers_of(d, s.extinction);
    if (!optics_.same_field) all.color = powers_of(d, s.color);
    all.length = s.length;
    all.weight = s.weight;
    find_cuts(d, s, all, active);
    Piece<V> part;
    bool whole = s.whole && cuts_.none();
    V z = s.begin, next = s.end, step = hn::Sub(s.end, s.begin);
    int halvings = 0, rounds = 0;
    active = hn::And(active, hn::Lt(z, s.end));
    while (!hn::AllFalse(d, active)) {
      if (!whole) {
        next = cuts_.next(d, z, hn::Min(s.end, hn::Add(z, step)));
        cut_out(d, all, z, next, part);
      }
      const bool may_refuse = halvings < kMostHalvings && ++rounds < kMostRounds;
      if (!add_piece(d, whole ? all : part, active, may_refuse, sum)) {
        ++halvings;
        step = hn::Mul(step, half);
        whole = false;
        continue;
      }
      if (whole) break;
      z = hn::IfThenElse(active, next, z);
      active = hn::And(active, hn::Lt(z, s.end));
      // the rest of the segment adds less than rounding
      active = hn::And(active, hn::Gt(sum.transparency, hn::Set(d, kInvisible)));
      if (halvings == 0) continue;
      // the lane that needed the short pieces may be finished
      --halvings;
      step = hn::Add(step, step);
    }
    return sum;
  }

 private:
  static constexpr int kMostHalvings = 40;
  static constexpr int kMostRounds = 100000;  // more than any valid segment needs
  static constexpr double kInvisible = 1e-20;
  // degree of the integrand's factor: kappa' or g
  static constexpr std::size_t kFactorDegree = kEmission ? kDegree : kDegree - 1;

  // A part of the segments on which the transfer functions are linear, with the fields on [-1, 1].
  template <class V>
  struct Piece {
    PowerScalar<V, kDegree> extinction, color;  // colour: if the fields differ
    V length, weight;
  };

  // Finds where fields take the values of breakpoints.
  template <class D, class V>
  HWY_INLINE void find_cuts(D d, const HigherOrderSegments<V, kDegree>& s, const Piece<V>& all,
                            hn::Mask<D> active) {
    cuts_.clear();
    const auto add = [&](const BernsteinScalar<V, kDegree>& f,
                         const PowerScalar<V, kDegree>& powers, const std::vector<double>& upper,
                         const WalkField& field) {
      return cuts_.add(d, f, powers, upper, field.base, field.intervals, active);
    };
    extinction_here_ = add(s.extinction, all.extinction, optics_.extinction.upper, extinction_);
    color_here_ = optics_.same_field ? extinction_here_
                                     : add(s.color, all.color, optics_.color.upper, color_);
  }

  template <class D, class V>
  HWY_INLINE void cut_out(D d, const Piece<V>& all, V begin, V end, Piece<V>& part) const {
    const V half = hn::Set(d, 0.5);
    const V middle = hn::Mul(half, hn::Add(begin, end)), share = hn::Mul(half, hn::Sub(end, begin));
    part.extinction = part_of(all.extinction, middle, share);
    if (!optics_.same_field) part.color = part_of(all.color, middle, share);
    part.length = hn::Mul(all.length, share);
    part.weight = hn::Div(all.weight, share);
  }

  // Adds a piece. Returns false if no rule meets the allowed error and the function `may_refuse`.
  template <class D, class V>
  HWY_INLINE bool add_piece(D d, const Piece<V>& piece, hn::Mask<D> active, bool may_refuse,
                            Radiance<V>& sum) {
    const PowerScalar<V, kDegree>& field = optics_.same_field ? piece.extinction : piece.color;
    const auto extinction = reader_at_middle(d, optics_.extinction, extinction_here_,
                                             extinction_.base, piece.extinction.c[0]);
    const auto color = optics_.same_field ? extinction
                                          : reader_at_middle(d, optics_.color, color_here_,
                                                             color_.base, piece.color.c[0]);
    const PieceColor<V> channels = color_on_piece(d, optics_, color, color_.base);
    const auto [offset, slope] = extinction_on_piece(d, optics_, extinction, extinction_.base);
    const auto depth = depth_of<kDegree>(d, piece.extinction.c, offset, slope, piece.length);
    // f minus the anchor for emission, else f' times the length of the piece
    V factor[kFactorDegree + 1];
    if constexpr (kEmission) {
      factor[0] = hn::Sub(field.c[0], channels.anchor);
      for (std::size_t k = 1; k <= kDegree; ++k) factor[k] = field.c[k];
    } else {
      for (std::size_t k = 1; k <= kDegree; ++k)
        factor[k - 1] = hn::Mul(hn::Set(d, 2.0 * static_cast<double>(k)), field.c[k]);
    }
    V weight = hn::Mul(sum.transparency, piece.weight);
    if constexpr (kEmission) weight = hn::Mul(weight, piece.length);
    const std::size_t nodes = nodes_for<kEmission, kFactorDegree>(
        d, ellipses_, depth, factor, channels, weight, active, ellipse_);
    if (nodes == 0 && may_refuse) return false;
    const SymmetricRule& rule = rules_[(nodes == 0 ? kMostSymmetricNodes : nodes) - 1];
    const Thickness thickness(
        hn::GetLane(hn::MaxOfLanes(d, hn::IfThenElseZero(active, depth.total))));
    const V zeta = transparency(d, depth.total, thickness);
    const PieceMeans<V> means = means_of(d, rule, depth, thickness, factor);
    V constant, linear;  // a channel is value * constant + slope * linear
    if constexpr (kEmission) {
      constant = hn::Mul(piece.length, means.of_one);
      linear = hn::Mul(piece.length, means.of_factor);
    } else {
      V even = hn::Sub(field.c[0], channels.anchor), odd = field.c[1];
      for (std::size_t k = 2; k <= kDegree; ++k)
        (k % 2 == 0 ? even : odd) = hn::Add(k % 2 == 0 ? even : odd, field.c[k]);
      constant = hn::Sub(hn::Set(d, 1.0), zeta);
      linear =
          hn::Add(hn::NegMulAdd(hn::Add(even, odd), zeta, hn::Sub(even, odd)), means.of_factor);
    }
    Radiance<V> light = light_of(d, channels, constant, linear, zeta);
    if (HWY_UNLIKELY(optics_.steep)) {
      // what a function takes the address of is in no register
      const Piece<V> seen = piece;
      const Radiance<V> unchecked = light;
      light = sound(d, seen, unchecked);
    }
    add_behind(light, active, sum);
    return true;
  }

  // sound_light of a piece. It finds the piece's intervals and ends once more: pieces under
  // functions that are not steep need not keep them.
  template <class D, class V>
  HWY_NOINLINE Radiance<V> sound(D d, const Piece<V>& piece, const Radiance<V>& light) const {
    const bool same = optics_.same_field;
    const PowerScalar<V, kDegree>& field = same ? piece.extinction : piece.color;
    const auto extinction = reader_at_middle(d, optics_.extinction, extinction_here_,
                                             extinction_.base, piece.extinction.c[0]);
    const auto color =
        same ? extinction
             : reader_at_middle(d, optics_.color, color_here_, color_.base, piece.color.c[0]);
    const auto end = [&](const PowerScalar<V, kDegree>& f, double z, double base)
                         HWY_ATTR { return end_of(d, f.c, kDegree, z, base); };
    return sound_light<kEmission>(
        d, optics_, light,
        PieceEnds<D>{color, extinction, end(field, -1.0, color_.base), end(field, 1.0, color_.base),
                     end(piece.extinction, -1.0, extinction_.base),
                     end(piece.extinction, 1.0, extinction_.base), piece.length});
  }

  template <class D, class V>
  static HWY_INLINE PieceMeans<V> means_of(D d, const SymmetricRule& rule,
                                           const PieceDepth<V, kDegree>& depth,
                                           const Thickness& thickness,
                                           const V (&factor)[kFactorDegree + 1]) {
    V moment[kFactorDegree + 1];  // mean of exp(-A) z^k
    for (V& m : moment) m = hn::Zero(d);
    if (rule.middle != 0)
      moment[0] = hn::Mul(hn::Set(d, rule.middle), transparency(d, depth.alpha[0], thickness));
    for (std::size_t k = 0; k < rule.pairs; ++k) {
      const V z = hn::Set(d, rule.z[k]), square = hn::Mul(z, z);
      V even = hn::MulAdd(square, depth.alpha[2], depth.alpha[0]);
      if constexpr (kDegree == 3) even = hn::MulAdd(hn::Mul(square, square), depth.alpha[4], even);
      const V odd = hn::Mul(z, hn::MulAdd(square, depth.alpha[3], depth.alpha[1]));
      V zeta[2] = {hn::Sub(even, odd), hn::Add(even, odd)};
      replace_by_transparencies(d, zeta, thickness);
      const auto& [before, behind] = zeta;
      const V both = hn::Mul(hn::Set(d, rule.weight[k]), hn::Add(behind, before));
      const V apart = hn::Mul(hn::Set(d, rule.weight[k] * rule.z[k]), hn::Sub(behind, before));
      moment[0] = hn::Add(moment[0], both);
      moment[1] = hn::Add(moment[1], apart);
      for (std::size_t j = 2; j <= kFactorDegree; ++j)
        moment[j] = hn::MulAdd(square, j % 2 == 0 ? both : apart, moment[j]);
    }
    V sum = hn::Mul(factor[0], moment[0]);
    for (std::size_t j = 1; j <= kFactorDegree; ++j) sum = hn::MulAdd(factor[j], moment[j], sum);
    return {moment[0], sum};
  }

  const OpticsTables& optics_;
  WalkField color_, extinction_;                    // of the cell
  IntervalRange color_here_{}, extinction_here_{};  // of the current segments
  SegmentCuts<kDegree> cuts_;
  const SymmetricRules& rules_;
  const BernsteinEllipses& ellipses_;
  EllipseChoice ellipse_;
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
