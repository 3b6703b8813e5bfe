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

#  include "hiac/render/shading-inl.hpp"
#  include "hiac/render/symmetric_rules.hpp"
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

// Segments of one vector of pixels: what lies between `begin` and `end` of u in [0, 1]. Those that
// do not count have no length.
template <class V>
struct QuadraticSegments {
  QuadraticScalar<V> color, extinction;  // one and the same where the fields are
  bool whole;                            // all from 0 to 1
  V begin, end;
  V length;  // world length of u from 0 to 1
  V weight;  // the transparency in front over the absolute error that may be made for u from 0 to 1
};

// A part of them on which no transfer function bends: fields on [0, 1].
template <class V>
struct QuadraticPiece {
  QuadraticScalar<V> color, extinction;
  V length, weight;
};

// How many nodes give the mean of p(z) exp(-A(z)) over [-1, 1] with the error allowed; 0 when more
// than there are. `wanted`: a bound of |p| over what is allowed; p is of the degree 1 or 2;
// `alpha`: coefficients of z, z^2, z^3 in A, which is positive in the middle. For the lane that
// needs most. `ellipse`: the best one of the last time, one of whose neighbours is tried besides,
// in turn.
template <std::size_t kDegree, class D, class V = hn::Vec<D>>
HWY_INLINE std::size_t quadratic_nodes(D d, const BernsteinEllipses& table, V wanted,
                                       const V (&alpha)[3], EllipseChoice& ellipse) {
  static_assert(kDegree == 1 || kDegree == 2);
  const V log = log_above(d, wanted);
  const V size[3] = {hn::Abs(alpha[0]), hn::Abs(alpha[1]), hn::Abs(alpha[2])};
  // on the ellipse |p| is at most rho^kDegree times as large (Bernstein's lemma)
  const auto needed_on = [&](std::size_t e) {
    const V reach = hn::Set(d, table.reach[e]);
    V grown = hn::MulAdd(reach, hn::MulAdd(reach, size[2], size[1]), size[0]);
    grown = hn::MulAdd(reach, grown, hn::Add(log, hn::Set(d, table.log_factor[e])));
    return hn::GetLane(
        hn::MaxOfLanes(d, hn::MulAdd(grown, hn::Set(d, table.rate[e]), hn::Set(d, 0.5 * kDegree))));
  };
  double fewest = needed_on(ellipse.best);
  const std::size_t other = ellipse.neighbour();
  if (const double needed = needed_on(other); needed < fewest) {
    fewest = needed;
    ellipse.best = other;
  }
  // the next number above
  if (!(fewest < static_cast<double>(kMostSymmetricNodes))) return 0;
  return fewest < 0 ? 1 : static_cast<std::size_t>(fewest) + 1;
}

// Integrates segments piece by piece, front to back.
//
// Segments are cut where a field takes a value at which its transfer function bends (roots of
// quadratics). On a piece, x from 0 to 1, extinction and colour are quadratics and the optical
// depth A a cubic. With chromaticity, integration by parts leaves
//     I = kappa(0) - kappa(1) exp(-A(1)) + integral of kappa' exp(-A),
// with emission I = length integral of g exp(-A). The integrals are Gauss-Legendre sums with as
// many nodes as the bound of polynomial_piece.hpp asks for (symmetric_rules.hpp), or pieces are
// halved.
template <bool kEmission>
class QuadraticWalk {
 public:
  QuadraticWalk(const OpticsTables& optics, IntervalRange color, IntervalRange extinction)
      : optics_(optics),
        color_(color),
        extinction_(extinction),
        rules_(symmetric_rules()),
        ellipses_(bernstein_ellipses()) {}

  template <class D, class V = hn::Vec<D>>
  HWY_INLINE Radiance<V> run(D d, const QuadraticSegments<V>& s, hn::Mask<D> active) {
    find_cuts(d, s);
    const V zero = hn::Zero(d);
    Radiance<V> sum{zero, zero, zero, hn::Set(d, 1.0)};
    V u = s.begin, next = s.end, step = hn::Sub(s.end, s.begin);
    QuadraticPiece<V> piece{s.color, s.extinction, s.length, s.weight};
    bool whole = s.whole && cut_count_ == 0;
    int halvings = 0;
    active = hn::And(active, hn::Lt(u, s.end));
    while (!hn::AllFalse(d, active)) {
      if (!whole) {
        next = next_cut(d, u, hn::Min(s.end, hn::Add(u, step)));
        cut_out(d, s, u, next, piece);
      }
      if (!add_piece(d, piece, active, halvings < kMostHalvings, sum)) {
        ++halvings;
        step = hn::Mul(step, hn::Set(d, 0.5));
        whole = false;
        continue;
      }
      if (whole) break;
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

  // The first cut between u and `end`, or that.
  template <class D, class V>
  HWY_INLINE V next_cut(D d, V u, V end) const {
    V next = end;
    for (std::size_t k = 0; k < cut_count_; ++k) {
      const V root = hn::LoadU(d, cuts_.data() + k * hn::Lanes(d));
      next = hn::IfThenElse(hn::And(hn::Gt(root, u), hn::Lt(root, next)), root, next);
    }
    return next;
  }

  template <class D, class V>
  HWY_INLINE void cut_out(D d, const QuadraticSegments<V>& s, V u, V v,
                          QuadraticPiece<V>& piece) const {
    const V part = hn::Sub(v, u);
    piece.extinction = part_of(d, s.extinction, u, v);
    piece.color = optics_.same_field ? piece.extinction : part_of(d, s.color, u, v);
    piece.length = hn::Mul(s.length, part);
    piece.weight = hn::Div(s.weight, part);
  }

  // The intervals in which a field is in the middle; neighbouring rays' are mostly one.
  template <std::size_t N, class D, class V>
  static HWY_INLINE IntervalReader<D> reader_of(D d, const TransferTable<N>& table,
                                                IntervalRange range, const QuadraticScalar<V>& f) {
    if (range.low == range.high) return IntervalReader<D>(d, range.low);
    const V middle = hn::Mul(hn::Set(d, 0.25), hn::Add(hn::Add(f.c0, f.c2), hn::Add(f.c1, f.c1)));
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

  // The optical depth along a piece, z = 2 x - 1 in [-1, 1]: middle + sum of alpha_k z^(k+1).
  template <class V>
  struct Depth {
    V middle, alpha[3];
    V total;
    V most;  // not less than any value
  };

  // From the extinction in Bernstein form.
  template <class D, class V>
  static HWY_INLINE Depth<V> depth_of(D d, V front, V middle, V back, V length) {
    const V zero = hn::Zero(d), third = hn::Set(d, 1.0 / 3), half = hn::Set(d, 0.5);
    const V scale = hn::Mul(length, hn::Set(d, 0.25));
    front = hn::Max(front, zero);
    back = hn::Max(back, zero);
    // mean + rise z + bend z^2, times 4
    const V ends = hn::Add(front, back), middles = hn::Add(middle, middle);
    const V mean = hn::Mul(scale, hn::Add(ends, middles));
    const V rise = hn::Mul(scale, hn::Sub(back, front));
    const V bend = hn::Mul(scale, hn::Sub(ends, middles));
    Depth<V> depth;
    depth.alpha[0] = hn::Mul(half, mean);
    depth.alpha[1] = hn::Mul(half, rise);
    depth.alpha[2] = hn::Mul(hn::Set(d, 1.0 / 6), bend);
    depth.middle = hn::Add(hn::Sub(depth.alpha[0], depth.alpha[1]), depth.alpha[2]);
    depth.total = hn::Max(hn::MulAdd(third, bend, mean), zero);
    depth.most = hn::Mul(length, hn::Max(hn::Max(front, back), hn::Max(middle, zero)));
    return depth;
  }

  // False when no rule meets what is allowed of the piece and it `may_refuse`.
  template <class D, class V>
  HWY_INLINE bool add_piece(D d, const QuadraticPiece<V>& piece, hn::Mask<D> active,
                            bool may_refuse, Radiance<V>& sum) {
    const auto extinction = reader_of(d, optics_.extinction, extinction_here_, piece.extinction);
    const auto color =
        optics_.same_field ? extinction : reader_of(d, optics_.color, color_here_, piece.color);
    const V tau_anchor = extinction(optics_.extinction.anchor);
    const V tau_slope = extinction(optics_.extinction.slope[0]);
    const V tau_value = extinction(optics_.extinction.value[0]);
    const auto tau = [&](V f) { return hn::MulAdd(tau_slope, hn::Sub(f, tau_anchor), tau_value); };
    const Depth<V> depth = depth_of(d, tau(piece.extinction.c0), tau(piece.extinction.c1),
                                    tau(piece.extinction.c2), piece.length);

    const V anchor = color(optics_.color.anchor);
    const QuadraticScalar<V> f{hn::Sub(piece.color.c0, anchor), hn::Sub(piece.color.c1, anchor),
                               hn::Sub(piece.color.c2, anchor)};
    const V slope[3] = {color(optics_.color.slope[0]), color(optics_.color.slope[1]),
                        color(optics_.color.slope[2])};
    const V value[3] = {color(optics_.color.value[0]), color(optics_.color.value[1]),
                        color(optics_.color.value[2])};
    const V integrand = kEmission ? hn::Mul(piece.length, largest_color(d, f, slope, value))
                                  : largest_rise(f, slope);
    const V wanted = hn::Mul(integrand, hn::Mul(sum.transparency, piece.weight));
    constexpr std::size_t kDegree = kEmission ? 2 : 1;
    const std::size_t nodes = quadratic_nodes<kDegree>(
        d, ellipses_, hn::IfThenElseZero(active, wanted), depth.alpha, ellipse_);
    if (nodes == 0 && may_refuse) return false;
    const SymmetricRule& rule = rules_[(nodes == 0 ? kMostSymmetricNodes : nodes) - 1];
    const bool thin = hn::AllTrue(d, hn::Lt(depth.most, hn::Set(d, kThin)));
    const V zeta = transparency(d, depth.total, thin);
    const Moments<V> moments = moments_of(d, rule, depth, thin);
    V constant, linear;  // a channel is value * constant + slope * linear
    const V difference = hn::Sub(f.c2, f.c0);
    const V bend = hn::Sub(hn::Add(f.c0, f.c2), hn::Add(f.c1, f.c1));
    if constexpr (kEmission) {
      const V mean = hn::Add(hn::Add(f.c0, f.c2), hn::Add(f.c1, f.c1));
      const V second = hn::MulAdd(bend, moments.of[2], hn::Mul(mean, moments.of[0]));
      const V first = hn::Mul(difference, moments.of[1]);
      constant = hn::Mul(piece.length, moments.of[0]);
      linear =
          hn::Mul(hn::Mul(piece.length, hn::Set(d, 0.25)), hn::Add(second, hn::Add(first, first)));
    } else {
      constant = hn::Sub(hn::Set(d, 1.0), zeta);
      linear = hn::Add(hn::NegMulAdd(f.c2, zeta, f.c0),
                       hn::MulAdd(difference, moments.of[0], hn::Mul(bend, moments.of[1])));
    }
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

  // Means over a piece of exp(-A) times 1, z and, of emission, z^2.
  template <class V>
  struct Moments {
    V of[3];
  };

  template <class D, class V>
  static HWY_INLINE Moments<V> moments_of(D d, const SymmetricRule& rule, const Depth<V>& depth,
                                          bool thin) {
    Moments<V> m{{hn::Zero(d), hn::Zero(d), hn::Zero(d)}};
    if (rule.middle != 0)
      m.of[0] = hn::Mul(hn::Set(d, rule.middle), transparency(d, depth.middle, thin));
    for (std::size_t k = 0; k < rule.pairs; ++k) {
      const V z = hn::Set(d, rule.z[k]), square = hn::Mul(z, z);
      const V even = hn::MulAdd(square, depth.alpha[1], depth.middle);
      const V odd = hn::Mul(z, hn::MulAdd(square, depth.alpha[2], depth.alpha[0]));
      V before = hn::Sub(even, odd), behind = hn::Add(even, odd);
      transparencies(d, before, behind, thin);
      const V both = hn::Mul(hn::Set(d, rule.weight[k]), hn::Add(behind, before));
      m.of[0] = hn::Add(m.of[0], both);
      m.of[1] =
          hn::MulAdd(hn::Set(d, rule.weight[k] * rule.z[k]), hn::Sub(behind, before), m.of[1]);
      if constexpr (kEmission) m.of[2] = hn::MulAdd(square, both, m.of[2]);
    }
    return m;
  }

  const OpticsTables& optics_;
  IntervalRange color_, extinction_;                // of the cell
  IntervalRange color_here_{}, extinction_here_{};  // of the segments at hand
  std::size_t cut_count_ = 0;
  std::vector<double> cuts_;  // vectors of u
  const SymmetricRules& rules_;
  const BernsteinEllipses& ellipses_;
  EllipseChoice ellipse_;
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
