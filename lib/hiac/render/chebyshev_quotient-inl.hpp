// Chebyshev series of rational functions in every lane, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_CHEBYSHEV_QUOTIENT_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_CHEBYSHEV_QUOTIENT_INL
#    undef HIAC_RENDER_CHEBYSHEV_QUOTIENT_INL
#  else
#    define HIAC_RENDER_CHEBYSHEV_QUOTIENT_INL
#  endif

#  include <cstddef>

#  include <hwy/highway.h>

#  include "hiac/render/chebyshev_points.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The Chebyshev series of polynomials of degree n over (1 + h z)^p, -1 < h < 1, p from 1 to 3 and
// less than n, from the polynomials of degree n that agree with them at the Chebyshev points.
//
// Behind the degree n - p of what is left by the division, the coefficients c_k of the quotient are
// those of its poles alone: with r = h / (1 + sqrt(1 - h^2)),
//     c_(n+m) = (-r)^m (C_0 + C_1 m + C_2 m^2),  m > -p, the last 3 - p of C_0, C_1, C_2 zero.
// At the Chebyshev points T_(2ln-k) and T_(2ln+k) are T_k: the coefficients that are found there
// count all of them together. With the sums of every 2n-th one
//     D_m = c_(n+m) + c_(3n+m) + c_(5n+m) + ... = (-r)^m (a + b m + e m^2)
// they are a_n = D_0 = a, a_k = c_k + D_(n-k) + D_(n+k), a_0 = c_0 + D_n and, where k > n - p,
// D_(k-n) + D_(n-k), so that
//     r a_(n-1) = (1 - r^2) b - (1 + r^2) (a + e),
//     r^2 a_(n-2) = (1 + r^4) (a + 4 e) - 2 (1 - r^4) b
// give b and e; and c_(n+m) = D_m - D_(m+2n).
template <class D, class V = hn::Vec<D>>
class ChebyshevQuotient {
 public:
  HWY_INLINE ChebyshevQuotient(D d, V r) : d_(d), r_(r), square_(hn::Mul(r, r)) {}

  // From c[k] = a_k, k up to n, to all the c_k that count: up to `end` if there are as many, or
  // more, where the last two are together below `negligible` in all lanes of `active`. Returns the
  // degree; 0 where it would be more than kMostChebyshevDegree in lanes that come off `active`. 2 n
  // is less than that.
  HWY_INLINE std::size_t expand(std::size_t p, std::size_t n, std::size_t end, V negligible,
                                hn::Mask<D>& active, V* c) const {
    if (p == 1) return expand_by<1>(n, end, negligible, active, c);
    if (p == 2) return expand_by<2>(n, end, negligible, active, c);
    return expand_by<3>(n, end, negligible, active, c);
  }

 private:
  template <std::size_t p>
  HWY_NOINLINE std::size_t expand_by(std::size_t n, std::size_t end, V negligible,
                                     hn::Mask<D>& active, V* c) const {
    const V a = c[n];
    const auto [b, e] = slopes<p>(c + n);
    V sum[kMostChebyshevDegree + 1];  // D_m
    sum[0] = a;
    V power = hn::Neg(r_), next = square_;
    std::size_t m = 1;
    for (;; m += 2) {
      sum[m] = hn::Mul(power, at<p>(m, a, b, e));
      sum[m + 1] = hn::Mul(next, at<p>(m + 1, a, b, e));
      const bool are_most = n + m + 3 > kMostChebyshevDegree;
      if ((n + m + 1 >= end && m >= n) || are_most) {
        const V last = hn::Add(hn::Abs(sum[m]), hn::Abs(sum[m + 1]));
        const auto ended = hn::Le(last, negligible);
        if (hn::AllTrue(d_, hn::Or(hn::Not(active), ended))) break;
        if (are_most) {
          active = hn::And(active, ended);
          return 0;
        }
      }
      power = hn::Mul(power, square_);
      next = hn::Mul(next, square_);
    }
    // what is behind the last one, not before D_n, is negligible
    const std::size_t last = m + 1;
    c[0] = hn::Sub(c[0], sum[n]);
    for (std::size_t k = 1; k < n; ++k) c[k] = hn::Sub(c[k], sum[n - k]);
    for (std::size_t k = n + 1; k <= last && k < 2 * n; ++k) c[k - n] = hn::Sub(c[k - n], sum[k]);
    for (std::size_t k = 0; k <= last; ++k) c[n + k] = sum[k];
    for (std::size_t k = 2 * n; k <= last; ++k) c[k - n] = hn::Sub(c[k - n], sum[k]);
    return n + last;
  }

  struct Slopes {
    V b, e;
  };
  // `a`: a_n, behind those before it.
  template <std::size_t p>
  [[nodiscard]] HWY_INLINE Slopes slopes(const V* a) const {
    V b = hn::Zero(d_), e = b;
    if constexpr (p > 1) {
      const V one = hn::Set(d_, 1.0), wide = hn::Add(one, square_);
      const V inverse = hn::Div(one, hn::Sub(one, square_));
      const V before = hn::Mul(r_, a[-1]);
      if constexpr (p > 2) {
        // 2 (1 - r^2)^2 e = r^2 a_(n-2) + 2 (1 + r^2) r a_(n-1) + (1 + 4 r^2 + r^4) a
        const V inner = hn::MulAdd(square_, hn::Add(square_, hn::Set(d_, 4.0)), one);
        const V twice = hn::MulAdd(square_, a[-2], hn::Mul(inner, a[0]));
        e = hn::MulAdd(wide, before, hn::Mul(twice, hn::Set(d_, 0.5)));
        e = hn::Mul(hn::Mul(e, inverse), inverse);
      }
      b = hn::Mul(hn::MulAdd(wide, hn::Add(a[0], e), before), inverse);
    }
    return {b, e};
  }

  // a + b m + e m^2.
  template <std::size_t p>
  [[nodiscard]] HWY_INLINE V at(std::size_t m, V a, V b, V e) const {
    const V place = hn::Set(d_, static_cast<double>(m));
    if constexpr (p > 2) b = hn::MulAdd(place, e, b);
    return p > 1 ? hn::MulAdd(place, b, a) : a;
  }

  D d_;
  V r_, square_;
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
