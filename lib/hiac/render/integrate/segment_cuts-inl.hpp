// Where fields of degree 2 and 3 along ray segments take the values of breakpoints, compiled once
// for every instruction set. Include from a file that Highway's foreach_target.h compiles
// repeatedly.

#if defined(HIAC_RENDER_SEGMENT_CUTS_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_SEGMENT_CUTS_INL
#    undef HIAC_RENDER_SEGMENT_CUTS_INL
#  else
#    define HIAC_RENDER_SEGMENT_CUTS_INL
#  endif

#  include <cstddef>
#  include <vector>

#  include <hwy/highway.h>

#  include "hiac/frame/interval_range.hpp"
#  include "hiac/render/integrate/polar_form-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A scalar along a ray, z in [-1, 1]: sum of c_k z^k.
template <class V, std::size_t kDegree>
struct PowerScalar {
  V c[kDegree + 1];
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE PowerScalar<V, 2> powers_of(D d, const BernsteinScalar<V, 2>& f) {
  const V half = hn::Set(d, 0.5), quarter = hn::Set(d, 0.25);
  const V ends = hn::Mul(quarter, hn::Add(f.c[0], f.c[2]));
  return {{hn::MulAdd(half, f.c[1], ends), hn::Mul(half, hn::Sub(f.c[2], f.c[0])),
           hn::NegMulAdd(half, f.c[1], ends)}};
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE PowerScalar<V, 3> powers_of(D d, const BernsteinScalar<V, 3>& f) {
  const V eighth = hn::Set(d, 0.125), three = hn::Set(d, 0.375);
  const V ends = hn::Add(f.c[0], f.c[3]), apart = hn::Sub(f.c[3], f.c[0]);
  const V inner = hn::Add(f.c[1], f.c[2]), inner_apart = hn::Sub(f.c[2], f.c[1]);
  return {{hn::MulAdd(three, inner, hn::Mul(eighth, ends)),
           hn::Mul(three, hn::Add(apart, inner_apart)), hn::Mul(three, hn::Sub(ends, inner)),
           hn::NegMulAdd(three, inner_apart, hn::Mul(eighth, apart))}};
}

// The restriction of f to [middle - half, middle + half], mapped to [-1, 1].
template <class V, std::size_t kDegree>
HWY_INLINE PowerScalar<V, kDegree> part_of(PowerScalar<V, kDegree> f, V middle, V half) {
  for (std::size_t r = 0; r < kDegree; ++r)
    for (std::size_t k = kDegree; k-- > r;) f.c[k] = hn::MulAdd(middle, f.c[k + 1], f.c[k]);
  V scale = half;
  for (std::size_t k = 1; k <= kDegree; ++k) {
    f.c[k] = hn::Mul(f.c[k], scale);
    scale = hn::Mul(scale, half);
  }
  return f;
}

// The cuts of one vector of segments, unsorted; those outside [-1, 1] and NaN are ignored.
template <std::size_t kDegree>
class SegmentCuts {
 public:
  void clear() { count_ = 0; }
  [[nodiscard]] bool none() const { return count_ == 0; }

  // Adds the points where a field takes the values of `upper` within a range of intervals; both
  // forms of the field are relative to `base`. Returns the intervals that the segments reach.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE IntervalRange add(D d, const BernsteinScalar<V, kDegree>& f,
                               const PowerScalar<V, kDegree>& powers,
                               const std::vector<double>& upper, double base, IntervalRange range,
                               hn::Mask<D> active) {
    if (range.low == range.high) return range;
    V least = hn::Min(f.c[0], f.c[kDegree]), most = hn::Max(f.c[0], f.c[kDegree]);
    for (std::size_t k = 1; k < kDegree; ++k) {
      least = hn::Min(least, f.c[k]);
      most = hn::Max(most, f.c[k]);
    }
    while (range.low < range.high &&
           hn::AllFalse(d, hn::And(active, hn::Le(least, hn::Set(d, upper[range.low] - base)))))
      ++range.low;
    while (range.low < range.high &&
           hn::AllFalse(d, hn::And(active, hn::Ge(most, hn::Set(d, upper[range.high - 1] - base)))))
      --range.high;
    if (range.low == range.high) return range;
    places_.resize((count_ + kDegree * (range.high - range.low)) * hn::Lanes(d));
    add_roots(d, f, powers, upper, base, range, active);
    return range;
  }

  // The first cut between z and `end`, or `end` if there is none.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE V next(D d, V z, V end) const {
    V next = end;
    for (std::size_t k = 0; k < count_; ++k) {
      const V root = hn::LoadU(d, places_.data() + k * hn::Lanes(d));
      next = hn::IfThenElse(hn::And(hn::Gt(root, z), hn::Lt(root, next)), root, next);
    }
    return next;
  }

 private:
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE void add_place(D d, V place) {
    hn::StoreU(place, d, places_.data() + count_++ * hn::Lanes(d));
  }

  // Adds the roots of c_0 + c_1 z + c_2 z^2 = value by the stable formula. A missing root is NaN.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE void add_roots(D d, const BernsteinScalar<V, 2>&, const PowerScalar<V, 2>& f,
                            const std::vector<double>& upper, double base, IntervalRange range,
                            hn::Mask<D>) {
    const V half = hn::Mul(hn::Set(d, 0.5), f.c[1]);
    for (std::size_t k = range.low; k < range.high; ++k) {
      const V c = hn::Sub(f.c[0], hn::Set(d, upper[k] - base));
      const V q = stable_sum(d, f.c[2], half, c);
      add_place(d, hn::Div(q, f.c[2]));
      add_place(d, hn::Div(c, q));
    }
  }

  // Returns q such that q / a and c / q are the roots of a z^2 + 2 b z + c.
  template <class D, class V = hn::Vec<D>>
  static HWY_INLINE V stable_sum(D, V a, V b, V c) {
    const V root = hn::Sqrt(hn::NegMulAdd(a, c, hn::Mul(b, b)));
    return hn::Neg(hn::Add(b, hn::CopySign(root, b)));
  }

  // The points between which a field is monotone, and its values there.
  template <class V>
  struct Turns {
    std::size_t parts;
    V place[kDegree + 1], value[kDegree + 1];
  };

  template <class D, class V = hn::Vec<D>>
  static HWY_INLINE Turns<V> turns_of(D d, const BernsteinScalar<V, 3>& f,
                                      const PowerScalar<V, 3>& powers, hn::Mask<D> active) {
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
    Turns<V> turns;
    turns.place[0] = hn::Neg(one);
    turns.value[0] = f.c[0];
    V least = hn::Sub(f.c[1], f.c[0]), most = least;
    for (std::size_t k = 1; k < 3; ++k) {
      const V slope = hn::Sub(f.c[k + 1], f.c[k]);
      least = hn::Min(least, slope);
      most = hn::Max(most, slope);
    }
    turns.parts = 1;
    if (!hn::AllFalse(d, hn::And(active, hn::And(hn::Lt(least, zero), hn::Gt(most, zero))))) {
      turns.parts = 3;
      const V a = hn::Mul(hn::Set(d, 3.0), powers.c[3]);
      const V q = stable_sum(d, a, powers.c[2], powers.c[1]);
      const auto inside = [&](V z) { return hn::IfThenElse(hn::Lt(hn::Abs(z), one), z, one); };
      const V u = inside(hn::Div(q, a)), v = inside(hn::Div(powers.c[1], q));
      turns.place[1] = hn::Min(u, v);
      turns.place[2] = hn::Max(u, v);
      for (std::size_t i = 1; i < 3; ++i) {
        V value = powers.c[3];
        for (std::size_t k = 3; k-- > 0;) value = hn::MulAdd(value, turns.place[i], powers.c[k]);
        turns.value[i] = value;
      }
    }
    turns.place[turns.parts] = one;
    turns.value[turns.parts] = f.c[3];
    return turns;
  }

  // Adds the roots: at most one between two turns.
  template <class D, class V = hn::Vec<D>>
  HWY_NOINLINE void add_roots(D d, const BernsteinScalar<V, 3>& f, const PowerScalar<V, 3>& powers,
                              const std::vector<double>& upper, double base, IntervalRange range,
                              hn::Mask<D> active) {
    const Turns<V> turns = turns_of(d, f, powers, active);
    for (std::size_t k = range.low; k < range.high; ++k) {
      const V value = hn::Set(d, upper[k] - base);
      for (std::size_t i = 0; i < turns.parts; ++i) {
        // a root at a turn that the field passes through counts once
        const auto from_below = hn::Lt(turns.value[i], value);
        const auto met = hn::And(active, hn::Xor(from_below, hn::Lt(turns.value[i + 1], value)));
        if (hn::AllFalse(d, met)) continue;
        const V low = turns.place[i], high = turns.place[i + 1];
        const V chord =
            hn::Div(hn::Sub(value, turns.value[i]), hn::Sub(turns.value[i + 1], turns.value[i]));
        const V place = root(d, powers, value, low, high,
                             hn::MulAdd(chord, hn::Sub(high, low), low), met, from_below);
        add_place(d, hn::IfThenElse(met, place, hn::Set(d, 2.0)));
      }
    }
  }

  // The point where fields that are monotone between `low` and `high` take a value: Newton's
  // method, safeguarded by bisection.
  template <class D, class V = hn::Vec<D>>
  static HWY_INLINE V root(D d, const PowerScalar<V, 3>& f, V value, V low, V high, V guess,
                           hn::Mask<D> where, hn::Mask<D> rises) {
    const V half = hn::Set(d, 0.5);
    const V constant = hn::Sub(f.c[0], value), twice = hn::Add(f.c[2], f.c[2]);
    const V thrice = hn::Mul(hn::Set(d, 3.0), f.c[3]);
    V z = hn::IfThenElseZero(where, hn::Min(hn::Max(guess, low), high));
    for (int step = 0; step < kMostSteps; ++step) {
      const V off = hn::MulAdd(hn::MulAdd(hn::MulAdd(f.c[3], z, f.c[2]), z, f.c[1]), z, constant);
      const V slope = hn::MulAdd(hn::MulAdd(thrice, z, twice), z, f.c[1]);
      const auto beyond = hn::Xor(rises, hn::Lt(off, hn::Zero(d)));
      high = hn::IfThenElse(beyond, z, high);
      low = hn::IfThenElse(beyond, low, z);
      V next = hn::Sub(z, hn::Div(off, slope));
      const auto inside = hn::And(hn::Ge(next, low), hn::Le(next, high));
      next = hn::IfThenElse(inside, next, hn::Mul(half, hn::Add(low, high)));
      const V change = hn::Abs(hn::Sub(next, z));
      z = hn::IfThenElse(where, next, z);
      // Newton's next step would be about the square of this one
      const auto close = hn::Or(hn::Le(change, hn::Set(d, 0x1p-52)),
                                hn::And(inside, hn::Le(change, hn::Set(d, 0x1p-29))));
      if (hn::AllTrue(d, hn::Or(hn::Not(where), close))) break;
    }
    return z;
  }

  static constexpr int kMostSteps = 64;

  std::size_t count_ = 0;
  std::vector<double> places_;  // vectors of z
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
