// exp(-a) for optical depths, and bounds of logarithms, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_TRANSPARENCY_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_TRANSPARENCY_INL
#    undef HIAC_RENDER_TRANSPARENCY_INL
#  else
#    define HIAC_RENDER_TRANSPARENCY_INL
#  endif

#  include <cstddef>
#  include <iterator>

#  include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Optical depths below this are thin.
inline constexpr double kThin = 0.1;

// exp(-r) by the terms up to r^12, or the first of them: coefficients from the last one on.
inline constexpr double kExponentialSeries[] = {1.0 / 479001600,
                                                -1.0 / 39916800,
                                                1.0 / 3628800,
                                                -1.0 / 362880,
                                                1.0 / 40320,
                                                -1.0 / 5040,
                                                1.0 / 720,
                                                -1.0 / 120,
                                                1.0 / 24,
                                                -1.0 / 6,
                                                0.5,
                                                -1.0,
                                                1.0};
inline constexpr std::size_t kThinFirst = 4;  // for thin ones, up to a^8

// exp(-a) for a up to 700, and exp(-700) from there on, to 2 units in the last place; a is not less
// than 0 but for rounding. With n = round(a / log 2) and r = a - n log 2, |r| <= log(2) / 2, it is
// exp(-r) 2^-n: what is left out of the series is below |r|^13 / 13! = 1.7e-16, and -n is added to
// the exponent's bits.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V exp_of_negative(D d, V a) {
  const hn::RebindToUnsigned<D> du;
  const V shift = hn::Set(d, 0x1.8p52);  // added, it leaves an integer in the lowest bits
  a = hn::Min(a, hn::Set(d, 700.0));
  const V shifted = hn::NegMulAdd(a, hn::Set(d, 1.4426950408889634), shift);
  const V minus_n = hn::Sub(shifted, shift);
  // log 2 in two parts, the first of 33 bits: products with n are exact
  V r = hn::MulAdd(minus_n, hn::Set(d, 6.93147180369123816490e-01), a);
  r = hn::MulAdd(minus_n, hn::Set(d, 1.90821492927058770002e-10), r);
  V sum = hn::Set(d, kExponentialSeries[0]);
  for (std::size_t k = 1; k < std::size(kExponentialSeries); ++k)
    sum = hn::MulAdd(sum, r, hn::Set(d, kExponentialSeries[k]));
  const auto exponent = hn::ShiftLeft<52>(hn::BitCast(du, shifted));
  return hn::BitCast(d, hn::Add(hn::BitCast(du, sum), exponent));
}

// exp(-a). Mostly a is small; what is left out of the series is at most kThin^9 / 9! = 3e-15.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V transparency(D d, V a, bool thin) {
  if (HWY_UNLIKELY(!thin)) return exp_of_negative(d, a);
  V sum = hn::Set(d, kExponentialSeries[kThinFirst]);
  for (std::size_t k = kThinFirst + 1; k < std::size(kExponentialSeries); ++k)
    sum = hn::MulAdd(sum, a, hn::Set(d, kExponentialSeries[k]));
  return sum;
}

// exp(-a) and exp(-b): as above, but every coefficient is loaded once.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void transparencies(D d, V& a, V& b, bool thin) {
  if (HWY_UNLIKELY(!thin)) {
    a = exp_of_negative(d, a);
    b = exp_of_negative(d, b);
    return;
  }
  V of_a = hn::Set(d, kExponentialSeries[kThinFirst]), of_b = of_a;
  for (std::size_t k = kThinFirst + 1; k < std::size(kExponentialSeries); ++k) {
    const V coefficient = hn::Set(d, kExponentialSeries[k]);
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
