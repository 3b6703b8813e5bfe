// Radiance of ray segments along which fields are quadratic, compiled once for every instruction
// set. Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_QUADRATIC_SHADING_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_QUADRATIC_SHADING_INL
#    undef HIAC_RENDER_QUADRATIC_SHADING_INL
#  else
#    define HIAC_RENDER_QUADRATIC_SHADING_INL
#  endif

#  include <vector>

#  include <hwy/highway.h>

#  include "hiac/render/quadratic_rules.hpp"
#  include "hiac/render/shading-inl.hpp"
#  include "hiac/render/transparency-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A scalar along a ray, u in [0, 1]: c0 (1-u)^2 + 2 c1 u (1-u) + c2 u^2.
template <class V>
struct QuadraticScalar {
  V c0, c1, c2;
};

// Its polar form: on [u, v] the coefficients are blossom(u, u), blossom(u, v), blossom(v, v).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V blossom(D d, const QuadraticScalar<V>& f, V u, V v) {
  const V one = hn::Set(d, 1.0);
  const V front = hn::MulAdd(hn::Sub(one, u), f.c0, hn::Mul(u, f.c1));
  const V back = hn::MulAdd(hn::Sub(one, u), f.c1, hn::Mul(u, f.c2));
  return hn::MulAdd(hn::Sub(one, v), front, hn::Mul(v, back));
}

// The part of the scalar on [u, v].
template <class D, class V = hn::Vec<D>>
HWY_INLINE QuadraticScalar<V> part_of(D d, const QuadraticScalar<V>& f, V u, V v) {
  return {blossom(d, f, u, u), blossom(d, f, u, v), blossom(d, f, v, v)};
}

// Segments of one vector of pixels: what lies between `begin` and `end` of u in [0, 1].
template <class V>
struct QuadraticSegments {
  QuadraticScalar<V> color, extinction;  // one and the same where the fields are
  V begin, end;
  V length;   // world length of u from 0 to 1
  V allowed;  // absolute error that may be made for u from 0 to 1, over the transparency in front
};

// The largest lane.
template <class D, class V = hn::Vec<D>>
HWY_INLINE double largest_lane(D d, V v) {
  return hn::GetLane(hn::MaxOfLanes(d, v));
}

// Integrates segments piece by piece, front to back.
//
// Segments are cut where a field takes a value at which its transfer function bends (roots of
// quadratics). On a piece, x from 0 to 1, extinction and colour are quadratics and the optical
// depth A a cubic. With chromaticity, integration by parts leaves
//     I = kappa(0) - kappa(1) exp(-A(1)) + integral of kappa' exp(-A),
// with emission I = length integral of g exp(-A). The integrals are Gauss-Legendre sums with as
// many nodes as the bound of polynomial_piece.hpp asks for (quadratic_rules.hpp), or pieces are
// halved.
template <bool kEmission>
class QuadraticWalk {
 public:
  QuadraticWalk(const OpticsTables& optics, IntervalRange color, IntervalRange extinction)
      : optics_(optics), color_(color), extinction_(extinction) {}

  template <class D, class V = hn::Vec<D>>
  HWY_INLINE Radiance<V> run(D d, const QuadraticSegments<V>& s, hn::Mask<D> active) {
    find_cuts(d, s);
    const V zero = hn::Zero(d);
    Radiance<V> sum{zero, zero, zero, hn::Set(d, 1.0)};
    V u = s.begin, step = hn::Sub(s.end, s.begin);
    active = hn::And(active, hn::Lt(u, s.end));
    int halvings = 0;
    while (!hn::AllFalse(d, active)) {
      V next = hn::Min(s.end, hn::Add(u, step));
      for (std::size_t k = 0; k < cut_count_; ++k) {
        const V root = hn::LoadU(d, cuts_.data() + k * hn::Lanes(d));
        next = hn::IfThenElse(hn::And(hn::Gt(root, u), hn::Lt(root, next)), root, next);
      }
      if (!add_piece(d, s, u, next, active, halvings < kMostHalvings, sum)) {
        ++halvings;
        step = hn::Mul(step, hn::Set(d, 0.5));
        continue;
      }
      u = hn::IfThenElse(active, next, u);
      active = hn::And(active, hn::Lt(u, s.end));
      // what is behind this adds less than rounding
      active = hn::And(active, hn::Gt(sum.transparency, hn::Set(d, kInvisible)));
    }
    return sum;
  }

 private:
  static constexpr int kMostHalvings = 40;
  static constexpr double kInvisible = 1e-20;

  // Where fields take the values of breakpoints, if anywhere.
  template <class D, class V>
  HWY_INLINE void find_cuts(D d, const QuadraticSegments<V>& s) {
    cut_count_ = 0;
    extinction_here_ = add_cuts(d, s.extinction, optics_.extinction.upper, extinction_);
    color_here_ =
        optics_.same_field ? extinction_here_ : add_cuts(d, s.color, optics_.color.upper, color_);
  }

  // Returns the intervals of these segments among those of the cell.
  //
  // f = c0 + 2 b u + a u^2; roots by the stable formula. One that is not there is not a number, and
  // compares as false.
  template <class D, class V>
  HWY_INLINE IntervalRange add_cuts(D d, const QuadraticScalar<V>& f,
                                    const std::vector<double>& upper, IntervalRange range) {
    if (range.low == range.high) return range;
    const std::size_t lanes = hn::Lanes(d);
    cuts_.resize((cut_count_ + 2 * (range.high - range.low)) * lanes);
    const V least = hn::Min(hn::Min(f.c0, f.c1), f.c2), most = hn::Max(hn::Max(f.c0, f.c1), f.c2);
    const V b = hn::Sub(f.c1, f.c0);
    const V a = hn::Sub(hn::Sub(f.c2, f.c1), b);
    IntervalRange here = range;
    for (std::size_t k = range.low; k < range.high; ++k) {
      const V value = hn::Set(d, upper[k]);
      if (hn::AllTrue(d, hn::Gt(least, value))) {
        here.low = k + 1;
        continue;
      }
      if (hn::AllTrue(d, hn::Lt(most, value))) {
        here.high = k;
        break;
      }
      const V c = hn::Sub(f.c0, value);
      const V root = hn::Sqrt(hn::NegMulAdd(a, c, hn::Mul(b, b)));
      const V q = hn::Neg(hn::Add(b, hn::CopySign(root, b)));
      hn::StoreU(hn::Div(q, a), d, cuts_.data() + cut_count_++ * lanes);
      hn::StoreU(hn::Div(c, q), d, cuts_.data() + cut_count_++ * lanes);
    }
    return here;
  }

  // The intervals in which a piece's middle lies; neighbouring rays' are mostly one.
  template <std::size_t N, class D, class V>
  static HWY_INLINE IntervalReader<D> reader_of(D d, const TransferTable<N>& table,
                                                IntervalRange range, V middle) {
    if (range.low == range.high) return IntervalReader<D>(d, range.low);
    const hn::RebindToSigned<D> di;
    auto interval = hn::Set(di, static_cast<std::int64_t>(range.low));
    for (std::size_t k = range.low; k < range.high; ++k) {
      const auto passed = hn::Ge(middle, hn::Set(d, table.upper[k]));
      interval = hn::Sub(interval, hn::VecFromMask(di, hn::RebindMask(di, passed)));
    }
    const std::int64_t first = hn::GetLane(interval);
    if (hn::AllTrue(di, hn::Eq(interval, hn::Set(di, first))))
      return IntervalReader<D>(d, static_cast<std::size_t>(first));
    return IntervalReader<D>(d, interval);
  }

  // The optical depth along a piece: alpha_1 x + alpha_2 x^2 + alpha_3 x^3.
  template <class V>
  struct Depth {
    V a1, a2, a3, total;
    V most;  // not less than any value
  };

  template <class D, class V>
  static HWY_INLINE Depth<V> depth_of(D d, V front, V middle, V back, V length) {
    const V zero = hn::Zero(d), third = hn::Set(d, 1.0 / 3);
    front = hn::Max(front, zero);
    back = hn::Max(back, zero);
    const V rise = hn::Sub(middle, front);
    const V bend = hn::Sub(hn::Sub(back, middle), rise);
    const V sum = hn::Add(hn::Add(front, middle), back);
    const V largest = hn::Max(hn::Max(front, back), hn::Max(middle, zero));
    return {hn::Mul(length, front), hn::Mul(length, rise), hn::Mul(hn::Mul(length, third), bend),
            hn::Max(hn::Mul(hn::Mul(length, third), sum), zero), hn::Mul(length, largest)};
  }

  // False when no rule meets what is allowed of the piece from u to v, unless it `must` be added.
  template <class D, class V>
  HWY_INLINE bool add_piece(D d, const QuadraticSegments<V>& s, V u, V v, hn::Mask<D> active,
                            bool may_refuse, Radiance<V>& sum) const {
    const QuadraticScalar<V> tau_field = part_of(d, s.extinction, u, v);
    const QuadraticScalar<V> field = optics_.same_field ? tau_field : part_of(d, s.color, u, v);
    const V half = hn::Set(d, 0.5);
    const V middle = hn::Mul(half, hn::Add(u, v));
    const auto extinction = reader_of(d, optics_.extinction, extinction_here_,
                                      blossom(d, s.extinction, middle, middle));
    const auto color = optics_.same_field ? extinction
                                          : reader_of(d, optics_.color, color_,
                                                      blossom(d, s.color, middle, middle));
    const auto tau = [&](V f) { return extinction.at(optics_.extinction, 0, f); };
    const V part = hn::Sub(v, u);
    const V length = hn::Mul(s.length, part);
    const Depth<V> depth =
        depth_of(d, tau(tau_field.c0), tau(tau_field.c1), tau(tau_field.c2), length);

    const V anchor = color(optics_.color.anchor);
    const QuadraticScalar<V> f{hn::Sub(field.c0, anchor), hn::Sub(field.c1, anchor),
                               hn::Sub(field.c2, anchor)};
    const V slope[3] = {color(optics_.color.slope[0]), color(optics_.color.slope[1]),
                        color(optics_.color.slope[2])};
    const V value[3] = {color(optics_.color.value[0]), color(optics_.color.value[1]),
                        color(optics_.color.value[2])};
    const V integrand =
        kEmission ? hn::Mul(length, largest_color(d, f, slope, value)) : largest_rise(f, slope);
    const V wanted = hn::Div(hn::Mul(integrand, sum.transparency), hn::Mul(s.allowed, part));
    const std::size_t nodes = nodes_for(d, depth, hn::IfThenElseZero(active, wanted));
    if (nodes == 0 && may_refuse) return false;
    const auto& rule = quadratic_rule(nodes == 0 ? kMostQuadraticNodes : nodes);
    const bool thin =
        hn::AllTrue(d, hn::Lt(hn::IfThenElseZero(active, depth.most), hn::Set(d, kThin)));
    const V zeta = transparency(d, depth.total, thin);
    V constant, linear;  // a channel is value * constant + slope * linear
    if constexpr (kEmission)
      emission_sums(d, rule, depth, thin, f, length, constant, linear);
    else
      chromaticity_sums(d, rule, depth, thin, f, zeta, constant, linear);
    const auto channel = [&](std::size_t c) {
      return hn::MulAdd(slope[c], linear, hn::Mul(value[c], constant));
    };
    add_behind(Radiance<V>{channel(0), channel(1), channel(2), zeta}, active, sum);
    return true;
  }

  // The largest |kappa'| at the ends of a piece, of any channel: kappa' is linear.
  template <class V>
  static HWY_INLINE V largest_rise(const QuadraticScalar<V>& f, const V (&slope)[3]) {
    const V steepest = hn::Max(hn::Max(hn::Abs(slope[0]), hn::Abs(slope[1])), hn::Abs(slope[2]));
    const V rise = hn::Max(hn::Abs(hn::Sub(f.c1, f.c0)), hn::Abs(hn::Sub(f.c2, f.c1)));
    return hn::Mul(steepest, hn::Add(rise, rise));
  }

  // A bound of |g|, of any channel.
  template <class D, class V>
  static HWY_INLINE V largest_color(D d, const QuadraticScalar<V>& f, const V (&slope)[3],
                                    const V (&value)[3]) {
    const V most = hn::Max(hn::Max(hn::Abs(f.c0), hn::Abs(f.c1)), hn::Abs(f.c2));
    V largest = hn::Zero(d);
    for (std::size_t c = 0; c < 3; ++c)
      largest = hn::Max(largest, hn::MulAdd(hn::Abs(slope[c]), most, hn::Abs(value[c])));
    return largest;
  }

  // `wanted`: bound of the factor of exp(-A) over the error allowed.
  template <class D, class V>
  static HWY_INLINE std::size_t nodes_for(D d, const Depth<V>& a, V wanted) {
    const double largest = largest_lane(d, wanted);
    if (!(largest > 0)) return 1;
    // Chebyshev coefficients of A on [0, 1], those of degree 1 and more
    const auto times = [d](double s, V v) { return hn::Mul(hn::Set(d, s), v); };
    const V c1 = hn::Add(times(0.5, hn::Add(a.a1, a.a2)), times(15.0 / 32, a.a3));
    const V c2 = hn::Add(times(1.0 / 8, a.a2), times(3.0 / 16, a.a3));
    return quadratic_nodes(kEmission ? 2 : 1, largest, largest_lane(d, hn::Abs(c1)),
                           largest_lane(d, hn::Abs(c2)),
                           largest_lane(d, hn::Abs(times(1.0 / 32, a.a3))));
  }

  template <class D, class V>
  static HWY_INLINE V transparency_at(D d, const Depth<V>& a, double x, bool thin) {
    const V at = hn::Set(d, x);
    return transparency(d, hn::Mul(at, hn::MulAdd(at, hn::MulAdd(at, a.a3, a.a2), a.a1)), thin);
  }

  template <class D, class V>
  static HWY_INLINE void chromaticity_sums(D d, const QuadraticRule& rule, const Depth<V>& depth,
                                           bool thin, const QuadraticScalar<V>& f, V zeta,
                                           V& constant, V& linear) {
    V front = hn::Zero(d), back = hn::Zero(d);  // integrals of (1 - x) exp(-A), x exp(-A)
    for (std::size_t k = 0; k < rule.count; ++k) {
      const V t = transparency_at(d, depth, rule.x[k], thin);
      front = hn::MulAdd(hn::Set(d, rule.w[k] * (1 - rule.x[k])), t, front);
      back = hn::MulAdd(hn::Set(d, rule.w[k] * rule.x[k]), t, back);
    }
    const V half = hn::MulAdd(hn::Sub(f.c1, f.c0), front, hn::Mul(hn::Sub(f.c2, f.c1), back));
    constant = hn::Sub(hn::Set(d, 1.0), zeta);
    linear = hn::Add(hn::NegMulAdd(f.c2, zeta, f.c0), hn::Add(half, half));
  }

  template <class D, class V>
  static HWY_INLINE void emission_sums(D d, const QuadraticRule& rule, const Depth<V>& depth,
                                       bool thin, const QuadraticScalar<V>& f, V length,
                                       V& constant, V& linear) {
    constant = linear = hn::Zero(d);
    for (std::size_t k = 0; k < rule.count; ++k) {
      const double x = rule.x[k], y = 1 - x;
      const V t = hn::Mul(hn::Set(d, rule.w[k]), transparency_at(d, depth, x, thin));
      const V here =
          hn::MulAdd(hn::Set(d, y * y), f.c0,
                     hn::MulAdd(hn::Set(d, 2 * x * y), f.c1, hn::Mul(hn::Set(d, x * x), f.c2)));
      constant = hn::Add(constant, t);
      linear = hn::MulAdd(t, here, linear);
    }
    constant = hn::Mul(constant, length);
    linear = hn::Mul(linear, length);
  }

  const OpticsTables& optics_;
  IntervalRange color_, extinction_;                // of the cell
  IntervalRange color_here_{}, extinction_here_{};  // of the segments at hand
  std::size_t cut_count_ = 0;
  std::vector<double> cuts_;  // vectors of u
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
