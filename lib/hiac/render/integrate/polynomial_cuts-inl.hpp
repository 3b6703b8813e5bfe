// Where polynomial fields along pieces of ray segments take the values of breakpoints, compiled
// once for every instruction set. Include from a file that Highway's foreach_target.h compiles
// repeatedly.

#if defined(HIAC_RENDER_POLYNOMIAL_CUTS_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_POLYNOMIAL_CUTS_INL
#    undef HIAC_RENDER_POLYNOMIAL_CUTS_INL
#  else
#    define HIAC_RENDER_POLYNOMIAL_CUTS_INL
#  endif

#  include <array>
#  include <cmath>
#  include <vector>

#  include <hwy/highway.h>

#  include "hiac/element/lane_polynomial-inl.hpp"
#  include "hiac/render/integrate/piece_optics-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

inline constexpr auto kTwiceOf = [] {  // 2 k as doubles, read from memory
  std::array<double, kMaxFieldDegree + 1> twice{};
  for (std::size_t k = 0; k < twice.size(); ++k) twice[k] = 2 * static_cast<double>(k);
  return twice;
}();

// Finds where monotone polynomials take target values between those at their ends, by Newton's
// method safeguarded by bisection.
template <class D, class V = hn::Vec<D>>
HWY_NOINLINE V root_of(D d, const LanePolynomial<V>& f, V target, V guess, hn::Mask<D> where,
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
    // the next step would be about the square of this one
    if (hn::AllTrue(d, hn::Or(hn::Not(where), hn::Le(change, hn::Set(d, 0x1p-29))))) break;
  }
  return z;
}

// Lowers `end`, where to end pieces in z in [-1, 1], in those of the `wide` lanes that may take a
// value of `upper`: to the first such point if the polynomial is monotone, else to the middle.
// Returns false if a piece may take such a value before its end.
template <class D, class V = hn::Vec<D>>
HWY_NOINLINE bool cut_at(D d, const LanePolynomial<V>& f, const std::vector<double>& upper,
                         const WalkField& field, hn::Mask<D> wide, V& end) {
  const auto [low, high] = field.intervals;
  if (low == high || f.degree == 0) return true;
  // bounds of the field; where it is monotone, its values at the ends
  const V zero = hn::Zero(d);
  V even_least = f.c[0], even_most = f.c[0], even = f.c[0];
  V odd = f.c[1], odd_size = hn::Abs(f.c[1]), bend = zero;
  for (std::size_t k = 2; k <= f.degree; ++k) {
    const V size = hn::Abs(f.c[k]);
    bend = hn::MulAdd(hn::Set(d, kTwiceOf[k]), size, bend);
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
  // a piece ends at a breakpoint only to within rounding
  const V doubt = hn::Set(d, 0x1p-46 * field.spread + 0x1p-51 * std::abs(field.base));
  auto meets = hn::Lt(hn::Set(d, 1.0), zero);
  for (std::size_t k = low; k < high; ++k) {
    const V value = hn::Set(d, upper[k] - field.base);
    meets = hn::Or(
        meets, hn::And(hn::Lt(least, hn::Sub(value, doubt)), hn::Gt(most, hn::Add(value, doubt))));
  }
  meets = hn::And(meets, wide);
  if (hn::AllFalse(d, meets)) return true;
  const auto once = hn::And(meets, monotone);
  if (hn::AllFalse(d, once)) {
    end = hn::IfThenElse(meets, hn::Min(end, zero), end);
    return false;
  }
  // the first value taken
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
  const V stop = hn::IfThenElseZero(once, root_of(d, f, target, chord, once, rises));
  end = hn::IfThenElse(meets, hn::Min(end, stop), end);
  return hn::AllFalse(d, hn::AndNot(once, meets));
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
