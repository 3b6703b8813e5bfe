// exp(-a) for optical depths, and bounds of logarithms, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_TRANSPARENCY_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_TRANSPARENCY_INL
#    undef HIAC_RENDER_TRANSPARENCY_INL
#  else
#    define HIAC_RENDER_TRANSPARENCY_INL
#  endif

#  include <hwy/contrib/math/math-inl.h>
#  include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Optical depths below this are thin.
inline constexpr double kThin = 0.1;

// exp(-a). Mostly a is small; what is left out of the series is at most kThin^9 / 9! = 3e-15.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V transparency(D d, V a, bool thin) {
  if (HWY_UNLIKELY(!thin)) return hn::Exp(d, hn::Neg(a));
  V sum = hn::Set(d, 1.0 / 40320);
  for (const double c : {-1.0 / 5040, 1.0 / 720, -1.0 / 120, 1.0 / 24, -1.0 / 6, 0.5, -1.0, 1.0})
    sum = hn::MulAdd(sum, a, hn::Set(d, c));
  return sum;
}

// exp(-a) and exp(-b): as above, but every coefficient is loaded once.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void transparencies(D d, V& a, V& b, bool thin) {
  if (HWY_UNLIKELY(!thin)) {
    a = hn::Exp(d, hn::Neg(a));
    b = hn::Exp(d, hn::Neg(b));
    return;
  }
  V of_a = hn::Set(d, 1.0 / 40320), of_b = of_a;
  for (const double c : {-1.0 / 5040, 1.0 / 720, -1.0 / 120, 1.0 / 24, -1.0 / 6, 0.5, -1.0, 1.0}) {
    const V coefficient = hn::Set(d, c);
    of_a = hn::MulAdd(of_a, a, coefficient);
    of_b = hn::MulAdd(of_b, b, coefficient);
  }
  a = of_a;
  b = of_b;
}

// Not less than the logarithm of a number that is not negative: that of the power of two above.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V log_above(D d, V x) {
  const hn::RebindToUnsigned<D> du;
  // 2^52 and the exponent's bits, as a number
  const auto bits = hn::Or(hn::ShiftRight<52>(hn::BitCast(du, x)), hn::Set(du, 0x433ULL << 52));
  const V exponent = hn::Sub(hn::BitCast(d, bits), hn::Set(d, 0x1p52 + 1022));
  return hn::Mul(exponent, hn::Set(d, 0.6931471805599454));
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
