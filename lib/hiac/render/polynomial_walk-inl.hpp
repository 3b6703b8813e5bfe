// Radiance of ray segments along which fields are polynomials, compiled once for every instruction
// set. Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_POLYNOMIAL_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_POLYNOMIAL_WALK_INL
#    undef HIAC_RENDER_POLYNOMIAL_WALK_INL
#  else
#    define HIAC_RENDER_POLYNOMIAL_WALK_INL
#  endif

#  include <cmath>
#  include <vector>

#  include <hwy/highway.h>

#  include "hiac/render/bernstein_tables.hpp"
#  include "hiac/render/shading-inl.hpp"
#  include "hiac/render/transparency-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A polynomial on [0, 1] in every lane, in Bernstein form; all of one degree.
template <class V>
struct LanePolynomial {
  std::size_t degree = 0;
  V c[kMaxFieldDegree + 1];
};

// What is left of a polynomial on [0, v], as one on [0, 1]: de Casteljau's algorithm.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void keep_front(D d, LanePolynomial<V>& f, V v) {
  const V rest = hn::Sub(hn::Set(d, 1.0), v);
  for (std::size_t r = 1; r <= f.degree; ++r)
    for (std::size_t i = f.degree; i >= r; --i)
      f.c[i] = hn::MulAdd(v, f.c[i], hn::Mul(rest, f.c[i - 1]));
}

// The same of [u, 1].
template <class D, class V = hn::Vec<D>>
HWY_INLINE void keep_back(D d, LanePolynomial<V>& f, V u) {
  const V rest = hn::Sub(hn::Set(d, 1.0), u);
  for (std::size_t r = 1; r <= f.degree; ++r)
    for (std::size_t i = 0; i + r <= f.degree; ++i)
      f.c[i] = hn::MulAdd(u, f.c[i + 1], hn::Mul(rest, f.c[i]));
}

// f(x) and f'(x).
template <class V>
struct ValueAndSlope {
  V value, slope;
};
template <class D, class V = hn::Vec<D>>
HWY_INLINE ValueAndSlope<V> evaluate(D d, const LanePolynomial<V>& f, V x) {
  if (f.degree == 0) return {f.c[0], hn::Zero(d)};
  const V rest = hn::Sub(hn::Set(d, 1.0), x);
  V c[kMaxFieldDegree + 1];
  for (std::size_t i = 0; i <= f.degree; ++i) c[i] = f.c[i];
  for (std::size_t r = 1; r < f.degree; ++r)
    for (std::size_t i = 0; i + r <= f.degree; ++i)
      c[i] = hn::MulAdd(x, c[i + 1], hn::Mul(rest, c[i]));
  return {hn::MulAdd(x, c[1], hn::Mul(rest, c[0])),
          hn::Mul(hn::Set(d, static_cast<double>(f.degree)), hn::Sub(c[1], c[0]))};
}

// Sum of coefficients times the entries of a row.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V combined(D d, const LanePolynomial<V>& f, const BernsteinRule::Row& row) {
  V sum = hn::Mul(hn::Set(d, row[0]), f.c[0]);
  for (std::size_t i = 1; i <= f.degree; ++i) sum = hn::MulAdd(hn::Set(d, row[i]), f.c[i], sum);
  return sum;
}

// A field in the cell at hand, as a walk sees it. Polynomials are of the field less `base`.
struct WalkField {
  IntervalRange intervals;  // of its transfer function, in the cell
  double base;
  double spread;  // not less than any magnitude of the field less base
};

// Integrates segments piece by piece, front to back.
//
// A piece ends where a field takes a value at which its transfer function bends or jumps. A
// polynomial whose Bernstein coefficients rise, or fall, takes it once, and Newton's method finds
// where; others are halved until they do not meet it or are monotone. On a piece, x from 0 to 1,
// extinction and colour are polynomials, and so is the optical depth A. With chromaticity,
// integration by parts leaves
//     I = kappa(0) - kappa(1) exp(-A(1)) + integral of kappa' exp(-A),
// with emission I = length integral of g exp(-A). The integrals are Gauss-Legendre sums with as
// many nodes as the bound of polynomial_piece.hpp asks for, or pieces are halved.
template <bool kEmission>
class PolynomialWalk {
 public:
  // `color` counts where the fields are two.
  PolynomialWalk(const OpticsTables& optics, const WalkField& color, const WalkField& extinction)
      : optics_(optics), color_(color), extinction_(extinction) {}

  // Adds segments behind what is in `sum`. `length`: of x from 0 to 1, in the world; `allowed`:
  // absolute error that may be made on it, over the transparency in front of `sum`. Lanes that are
  // active must have finite numbers, and those that are not, too. Returns the lanes that could not
  // be done.
  template <class D, class V = hn::Vec<D>>
  HWY_NOINLINE hn::Mask<D> add(D d, const LanePolynomial<V>& extinction,
                               const LanePolynomial<V>& color, V length, V allowed,
                               hn::Mask<D> active, Radiance<V>& sum) const {
    const V one = hn::Set(d, 1.0), half = hn::Set(d, 0.5);
    V u = hn::Zero(d), v = one;
    LanePolynomial<V> tau_field = extinction, color_field;
    if (!optics_.same_field) color_field = color;
    for (int round = 0; round < kMostRounds; ++round) {
      if (hn::AllFalse(d, active)) return active;
      const V width = hn::Sub(v, u);
      const auto wide = hn::And(active, hn::Gt(width, hn::Set(d, kNarrow)));
      V part = cut_at(d, tau_field, optics_.extinction.upper, extinction_, wide);
      if (!optics_.same_field)
        part = hn::Min(part, cut_at(d, color_field, optics_.color.upper, color_, wide));
      bool ready = hn::AllTrue(d, hn::Eq(part, one));
      if (ready && !add_piece(d, tau_field, optics_.same_field ? tau_field : color_field,
                              hn::Mul(length, width), hn::Mul(allowed, width), active,
                              hn::AllTrue(d, hn::Or(hn::Not(active), wide)), sum)) {
        ready = false;
        part = half;
      }
      if (ready) {
        u = v;
        v = one;
        // what is behind this adds less than rounding
        active = hn::And(active,
                         hn::And(hn::Lt(u, one), hn::Gt(sum.transparency, hn::Set(d, kInvisible))));
        if (hn::AllFalse(d, active)) return active;
        tau_field = extinction;
        keep_back(d, tau_field, u);
        if (optics_.same_field) continue;
        color_field = color;
        keep_back(d, color_field, u);
      } else {
        part = hn::Max(part, hn::Min(hn::Div(hn::Set(d, 0.5 * kNarrow), width), one));
        v = hn::IfThenElse(hn::Eq(part, one), v, hn::MulAdd(width, part, u));
        keep_front(d, tau_field, part);
        if (!optics_.same_field) keep_front(d, color_field, part);
      }
    }
    return active;
  }

 private:
  static constexpr int kMostRounds = 1000;
  static constexpr double kNarrow = 0x1p-40;  // breakpoints in shorter pieces do not count
  static constexpr double kInvisible = 1e-20;

  // Where to end pieces of which `wide` lanes meet a breakpoint: at the first one if it is known,
  // or halfway; 1 for the others.
  template <class D, class V = hn::Vec<D>>
  static HWY_NOINLINE V cut_at(D d, const LanePolynomial<V>& f, const std::vector<double>& upper,
                               const WalkField& field, hn::Mask<D> wide) {
    const V one = hn::Set(d, 1.0);
    const auto [low, high] = field.intervals;
    if (low == high) return one;
    V least = f.c[0], most = f.c[0];
    for (std::size_t i = 1; i <= f.degree; ++i) {
      least = hn::Min(least, f.c[i]);
      most = hn::Max(most, f.c[i]);
    }
    // a piece that ends at a breakpoint does so to within rounding
    const V doubt = hn::Set(d, 0x1p-46 * field.spread + 0x1p-51 * std::abs(field.base));
    auto meets = hn::Lt(one, hn::Zero(d));
    for (std::size_t k = low; k < high; ++k) {
      const V value = hn::Set(d, upper[k] - field.base);
      meets = hn::Or(meets, hn::And(hn::Lt(least, hn::Sub(value, doubt)),
                                    hn::Gt(most, hn::Add(value, doubt))));
    }
    meets = hn::And(meets, wide);
    if (hn::AllFalse(d, meets)) return one;
    auto rises = meets, falls = meets;
    for (std::size_t i = 1; i <= f.degree; ++i) {
      rises = hn::And(rises, hn::Ge(f.c[i], f.c[i - 1]));
      falls = hn::And(falls, hn::Le(f.c[i], f.c[i - 1]));
    }
    const V part = hn::IfThenElse(meets, hn::Set(d, 0.5), one);
    const auto monotone = hn::Or(rises, falls);
    if (hn::AllFalse(d, monotone)) return part;
    // the first that is met
    const V after = hn::Add(f.c[0], doubt), before = hn::Sub(f.c[0], doubt);
    V target = f.c[0];
    for (std::size_t k = low; k < high; ++k) {
      const V value = hn::Set(d, upper[k] - field.base);
      target = hn::IfThenElse(hn::And(falls, hn::Lt(value, before)), value, target);
    }
    for (std::size_t k = high; k-- > low;) {
      const V value = hn::Set(d, upper[k] - field.base);
      target = hn::IfThenElse(hn::And(rises, hn::Gt(value, after)), value, target);
    }
    return hn::IfThenElse(monotone, root(d, f, target, monotone, rises), part);
  }

  // Where monotone polynomials take values between those at their ends: Newton's method, kept
  // between bounds.
  template <class D, class V = hn::Vec<D>>
  static HWY_NOINLINE V root(D d, const LanePolynomial<V>& f, V target, hn::Mask<D> where,
                             hn::Mask<D> rises) {
    V low = hn::Zero(d), high = hn::Set(d, 1.0);
    const V chord = hn::Div(hn::Sub(target, f.c[0]), hn::Sub(f.c[f.degree], f.c[0]));
    V x = hn::Min(hn::Max(chord, low), high);
    x = hn::IfThenElse(where, x, hn::Set(d, 0.5));
    for (int step = 0; step < 64; ++step) {
      const auto at = evaluate(d, f, x);
      const V off = hn::Sub(at.value, target);
      const auto beyond = hn::Xor(rises, hn::Lt(off, hn::Zero(d)));
      high = hn::IfThenElse(beyond, x, high);
      low = hn::IfThenElse(beyond, low, x);
      V next = hn::Sub(x, hn::Div(off, at.slope));
      const auto inside = hn::And(hn::Ge(next, low), hn::Le(next, high));
      next = hn::IfThenElse(inside, next, hn::Mul(hn::Add(low, high), hn::Set(d, 0.5)));
      const V change = hn::Abs(hn::Sub(next, x));
      x = hn::IfThenElse(where, next, x);
      // the next step would be as short as this one squared
      if (hn::AllTrue(d, hn::Or(hn::Not(where), hn::Le(change, hn::Set(d, 0x1p-30))))) break;
    }
    return x;
  }

  // The intervals in which the middles of pieces lie; neighbouring rays' are mostly one.
  template <std::size_t N, class D, class V = hn::Vec<D>>
  static HWY_INLINE IntervalReader<D> reader_of(D d, const TransferTable<N>& table,
                                                const WalkField& field,
                                                const LanePolynomial<V>& f) {
    const auto [low, high] = field.intervals;
    if (low == high) return IntervalReader<D>(d, low);
    const V middle = combined(d, f, bernstein_rule(f.degree, 1).value[0]);
    const hn::RebindToSigned<D> di;
    auto interval = hn::Set(di, static_cast<std::int64_t>(low));
    for (std::size_t k = low; k < high; ++k) {
      const auto passed = hn::Ge(middle, hn::Set(d, table.upper[k] - field.base));
      interval = hn::Sub(interval, hn::VecFromMask(di, hn::RebindMask(di, passed)));
    }
    const std::int64_t first = hn::GetLane(interval);
    if (hn::AllTrue(di, hn::Eq(interval, hn::Set(di, first))))
      return IntervalReader<D>(d, static_cast<std::size_t>(first));
    return IntervalReader<D>(d, interval);
  }

  // A transfer function's channel on a piece: value + slope * (f - anchor), f less the base.
  template <class V>
  struct Channels {
    V anchor, value[3], slope[3], steepest;
  };
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE Channels<V> channels_of(D d, const IntervalReader<D>& reader, double base) const {
    Channels<V> c;
    c.anchor = hn::Sub(reader(optics_.color.anchor), hn::Set(d, base));
    c.steepest = hn::Zero(d);
    for (std::size_t k = 0; k < 3; ++k) {
      c.value[k] = reader(optics_.color.value[k]);
      c.slope[k] = reader(optics_.color.slope[k]);
      c.steepest = hn::Max(c.steepest, hn::Abs(c.slope[k]));
    }
    return c;
  }

  // False when no rule meets what is allowed and the piece `may_refuse`.
  template <class D, class V = hn::Vec<D>>
  HWY_NOINLINE bool add_piece(D d, const LanePolynomial<V>& tau_field,
                              const LanePolynomial<V>& field, V length, V allowed,
                              hn::Mask<D> active, bool may_refuse, Radiance<V>& sum) const {
    const auto extinction = reader_of(d, optics_.extinction, extinction_, tau_field);
    const auto color = optics_.same_field ? extinction : reader_of(d, optics_.color, color_, field);
    const Channels<V> channels =
        channels_of(d, color, optics_.same_field ? extinction_.base : color_.base);
    // the optical depth's derivative
    LanePolynomial<V> tau;
    tau.degree = tau_field.degree;
    const V slope = hn::Mul(extinction(optics_.extinction.slope[0]), length);
    const V value = hn::Mul(extinction(optics_.extinction.value[0]), length);
    const V anchor = hn::Sub(extinction(optics_.extinction.anchor), hn::Set(d, extinction_.base));
    V total = hn::Zero(d), most = hn::Zero(d);
    for (std::size_t i = 0; i <= tau.degree; ++i) {
      tau.c[i] = hn::MulAdd(slope, hn::Sub(tau_field.c[i], anchor), value);
      total = hn::Add(total, tau.c[i]);
      most = hn::Max(most, tau.c[i]);
    }
    total =
        hn::Max(hn::Mul(total, hn::Set(d, 1 / static_cast<double>(tau.degree + 1))), hn::Zero(d));
    const V weight = hn::IfThenElseZero(active, hn::Div(sum.transparency, allowed));
    const V offset = hn::NegMulAdd(slope, anchor, value);
    const std::size_t nodes = nodes_for(d, tau, slope, offset, field, channels, length, weight);
    if (nodes == 0 && may_refuse) return false;
    const std::size_t used = nodes == 0 ? kMostLaneNodes : nodes;
    const bool thin = hn::AllTrue(d, hn::Lt(hn::IfThenElseZero(active, most), hn::Set(d, kThin)));
    const V zeta = transparency(d, total, thin);
    V constant, linear;  // a channel is value * constant + slope * linear
    if constexpr (kEmission)
      emission_sums(d, used, tau, thin, field, channels.anchor, length, constant, linear);
    else
      chromaticity_sums(d, used, tau, thin, field, channels.anchor, zeta, constant, linear);
    const auto channel = [&](std::size_t c) {
      return hn::MulAdd(channels.slope[c], linear, hn::Mul(channels.value[c], constant));
    };
    add_behind(Radiance<V>{channel(0), channel(1), channel(2), zeta}, active, sum);
    return true;
  }

  // How many nodes integrate p exp(-A) over [0, 1] with an error of at most 1 / weight, p being
  // kappa' or g: the bound of polynomial_piece.hpp on the best of some ellipses, for the lane that
  // needs most. 0: more than there are. `tau` is offset + slope times its field.
  template <class D, class V = hn::Vec<D>>
  HWY_NOINLINE std::size_t nodes_for(D d, const LanePolynomial<V>& tau, V slope, V offset,
                                     const LanePolynomial<V>& field, const Channels<V>& channels,
                                     V length, V weight) const {
    V t[kMaxFieldDegree + 3], f[kMaxFieldDegree + 1];  // Chebyshev coefficients, then magnitudes
    const std::size_t n = tau.degree, m = field.degree;
    to_chebyshev(d, field, f);
    if (optics_.same_field)
      for (std::size_t k = 0; k <= n; ++k)
        t[k] = k == 0 ? hn::MulAdd(slope, f[0], offset) : hn::Mul(slope, f[k]);
    else
      to_chebyshev(d, tau, t);
    t[n + 1] = t[n + 2] = hn::Zero(d);
    V depth[kMaxFieldDegree + 2];
    for (std::size_t k = 1; k <= n + 1; ++k) {
      const V below = k == 1 ? hn::Add(t[0], t[0]) : t[k - 1];
      depth[k] =
          hn::Abs(hn::Mul(hn::Set(d, 0.25 / static_cast<double>(k)), hn::Sub(below, t[k + 1])));
    }
    if constexpr (kEmission) f[0] = hn::Sub(f[0], channels.anchor);
    for (std::size_t k = 0; k <= m; ++k) f[k] = hn::Abs(f[k]);
    const V steepness = hn::Mul(channels.steepest, weight);
    V brightest = hn::Zero(d);
    if constexpr (kEmission)
      brightest =
          hn::Mul(weight, hn::Max(hn::Max(hn::Abs(channels.value[0]), hn::Abs(channels.value[1])),
                                  hn::Abs(channels.value[2])));
    const EllipseTable& ellipses = ellipse_table();
    const auto counts = hn::Gt(weight, hn::Zero(d));
    const auto needed_on = [&](std::size_t e) {
      V grown = hn::Set(d, ellipses.log_factor[e]), p = hn::Zero(d);
      for (std::size_t k = 1; k <= n + 1; ++k)
        grown = hn::MulAdd(hn::Set(d, ellipses.value[e][k]), depth[k], grown);
      const auto& row = kEmission ? ellipses.value[e] : ellipses.derivative[e];
      for (std::size_t k = kEmission ? 0 : 1; k <= m; ++k)
        p = hn::MulAdd(hn::Set(d, row[k]), f[k], p);
      p = hn::MulAdd(p, steepness, brightest);
      if constexpr (kEmission) p = hn::Mul(p, length);
      const V needed = hn::Mul(hn::Add(grown, log_above(d, p)), hn::Set(d, ellipses.rate[e]));
      return hn::GetLane(hn::MaxOfLanes(d, hn::IfThenElseZero(counts, needed)));
    };
    // the number falls and then rises with the ellipse; the last piece's is a good guess
    double fewest = needed_on(ellipse_);
    bool falls = false;
    while (ellipse_ + 1 < EllipseTable::kCount) {
      const double larger = needed_on(ellipse_ + 1);
      if (!(larger < fewest)) break;
      fewest = larger;
      ++ellipse_;
      falls = true;
    }
    while (!falls && ellipse_ > 0) {
      const double smaller = needed_on(ellipse_ - 1);
      if (!(smaller < fewest)) break;
      fewest = smaller;
      --ellipse_;
    }
    if (!(fewest <= static_cast<double>(kMostLaneNodes))) return 0;
    return static_cast<std::size_t>(std::max(1.0, std::ceil(fewest)));
  }

  // Not less than the logarithm of a number that is not negative: that of the power of two above.
  template <class D, class V = hn::Vec<D>>
  static HWY_INLINE V log_above(D d, V x) {
    const hn::RebindToSigned<D> di;
    const auto exponent = hn::Sub(hn::ShiftRight<52>(hn::BitCast(di, x)), hn::Set(di, 1022));
    return hn::Mul(hn::ConvertTo(d, exponent), hn::Set(d, 0.6931471805599454));
  }

  template <class D, class V = hn::Vec<D>>
  static HWY_INLINE void to_chebyshev(D d, const LanePolynomial<V>& f, V* c) {
    const auto& matrix = bernstein_bases(f.degree).to_chebyshev;
    const std::size_t n = f.degree, half = (n + 1) / 2;
    V even[kMaxFieldDegree / 2 + 1], odd[kMaxFieldDegree / 2 + 1];
    for (std::size_t i = 0; i < half; ++i) {
      even[i] = hn::Add(f.c[i], f.c[n - i]);
      odd[i] = hn::Sub(f.c[i], f.c[n - i]);
    }
    for (std::size_t k = 0; k <= n; ++k) {
      const V* part = k % 2 == 0 ? even : odd;
      c[k] = n % 2 == 0 ? hn::Mul(hn::Set(d, matrix[k][half]), f.c[half]) : hn::Zero(d);
      for (std::size_t i = 0; i < half; ++i)
        c[k] = hn::MulAdd(hn::Set(d, matrix[k][i]), part[i], c[k]);
    }
  }

  template <class D, class V = hn::Vec<D>>
  static HWY_NOINLINE void chromaticity_sums(D d, std::size_t nodes, const LanePolynomial<V>& tau,
                                             bool thin, const LanePolynomial<V>& f, V anchor,
                                             V zeta, V& constant, V& linear) {
    const BernsteinRule &depth = bernstein_rule(tau.degree, nodes),
                        &rule = bernstein_rule(f.degree, nodes);
    V sum = hn::Zero(d);
    for (std::size_t k = 0; k < nodes; ++k) {
      const V t = transparency(d, combined(d, tau, depth.integral[k]), thin);
      sum = hn::MulAdd(hn::Mul(hn::Set(d, rule.weight[k]), t), combined(d, f, rule.derivative[k]),
                       sum);
    }
    constant = hn::Sub(hn::Set(d, 1.0), zeta);
    linear =
        hn::Add(hn::NegMulAdd(hn::Sub(f.c[f.degree], anchor), zeta, hn::Sub(f.c[0], anchor)), sum);
  }

  template <class D, class V = hn::Vec<D>>
  static HWY_NOINLINE void emission_sums(D d, std::size_t nodes, const LanePolynomial<V>& tau,
                                         bool thin, const LanePolynomial<V>& f, V anchor, V length,
                                         V& constant, V& linear) {
    const BernsteinRule &depth = bernstein_rule(tau.degree, nodes),
                        &rule = bernstein_rule(f.degree, nodes);
    constant = linear = hn::Zero(d);
    for (std::size_t k = 0; k < nodes; ++k) {
      const V t = hn::Mul(hn::Set(d, rule.weight[k]),
                          transparency(d, combined(d, tau, depth.integral[k]), thin));
      constant = hn::Add(constant, t);
      linear = hn::MulAdd(t, hn::Sub(combined(d, f, rule.value[k]), anchor), linear);
    }
    constant = hn::Mul(constant, length);
    linear = hn::Mul(linear, length);
  }

  const OpticsTables& optics_;
  WalkField color_, extinction_;
  mutable std::size_t ellipse_ = EllipseTable::kCount - 1;  // best for the last piece
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
