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

// Taylor coefficients of exp(-r) up to r^12, highest power first.
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

// exp(-a) for a up to 700, and exp(-700) from there on, to 2 units in the last place; a is at least
// 0 up to rounding. With n = round(a / log 2) and r = a - n log 2, |r| <= log(2) / 2, the result is
// exp(-r) 2^-n: the truncation error of the series is below |r|^13 / 13! = 1.7e-16, and -n is added
// to the exponent's bits.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V exp_of_negative(D d, V a) {
  const hn::RebindToUnsigned<D> du;
  const V shift = hn::Set(d, 0x1.8p52);  // adding it leaves an integer in the lowest bits
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

// How exp(-a) is computed for optical depths up to `most`: by a polynomial of a 2^-halvings,
// squared `halvings` times.
//
// The polynomials are 1 - a q(a), where q interpolates (1 - exp(-a)) / a at Chebyshev points of [0,
// 0.08] and of [0, 0.5]: exact for a = 0, with an error of at most 3e-15. Every squaring doubles
// the relative error of a value that is at most 1.
struct Thickness {
  static constexpr double kThin = 0.08, kModerate = 0.5;
  static constexpr int kMostHalvings = 3;

  bool thin;
  int halvings;  // more than kMostHalvings: exp_of_negative

  explicit Thickness(double most) : thin(most <= kThin), halvings(0) {
    for (double reach = kModerate; !(most <= reach) && halvings <= kMostHalvings; reach += reach)
      ++halvings;
  }
};

// Replaces several optical depths by exp(-a), loading each coefficient once.
template <std::size_t kCount, class D, class V = hn::Vec<D>>
HWY_INLINE void replace_by_transparencies(D d, V (&a)[kCount], const Thickness& thickness) {
  const auto by_polynomial = [&](V leading, const auto& others) HWY_ATTR {
    V sum[kCount];
    for (V& v : sum) v = leading;
    for (const double c : others) {
      const V coefficient = hn::Set(d, c);
      for (std::size_t i = 0; i < kCount; ++i) sum[i] = hn::MulAdd(sum[i], a[i], coefficient);
    }
    for (std::size_t i = 0; i < kCount; ++i) a[i] = sum[i];
  };
  if (thickness.thin) {
    static constexpr double kOthers[] = {-0.008329152389621234, 0.041666493728367164,
                                         -0.16666666342890418,  0.4999999999778142,
                                         -0.9999999999999754,   1.0};
    by_polynomial(hn::Set(d, 0.0013421508324993898), kOthers);
  } else if (thickness.halvings <= Thickness::kMostHalvings) {
    static constexpr double kOthers[] = {
        2.4304403409224723e-05, -0.00019816620867329842, 0.001388817075883603,
        -0.00833332099111139,   0.04166666547209921,     -0.16666666660865045,
        0.49999999999891376,    -0.9999999999999967,     1.0};
    static constexpr double kScale[Thickness::kMostHalvings + 1] = {1, 0.5, 0.25, 0.125};
    const V scale = hn::Set(d, kScale[thickness.halvings]);
    for (V& v : a) v = hn::Mul(v, scale);
    by_polynomial(hn::Set(d, -2.2038692849545893e-06), kOthers);
    for (int k = 0; k < thickness.halvings; ++k)
      for (V& v : a) v = hn::Mul(v, v);
  } else {
    for (V& v : a) v = exp_of_negative(d, v);
  }
}

// exp(-a).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V transparency(D d, V a, const Thickness& thickness) {
  V all[1] = {a};
  replace_by_transparencies(d, all, thickness);
  return all[0];
}

// An upper bound of the logarithm of a number >= 0: the logarithm of the next power of two.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V log_above(D d, V x) {
  const hn::RebindToUnsigned<D> du;
  // 2^52 plus the exponent's bits, as a double
  const auto bits = hn::Or(hn::ShiftRight<52>(hn::BitCast(du, x)), hn::Set(du, 0x433ULL << 52));
  const V exponent = hn::Sub(hn::BitCast(d, bits), hn::Set(d, 0x1p52 + 1022));
  return hn::Mul(exponent, hn::Set(d, 0.6931471805599454));
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
