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

// From the coefficients of a polynomial of z in [-1, 1] to those, up to kMostChebyshevDegree, of it
// over (1 + h z)^pole_order, -1 < h < 1, pole_order from 1 to 3.
//
// With z T_k = (T_(k-1) + T_(k+1)) / 2 the coefficients of p = (1 + h z) q are
//     p_k = q_k + h/2 (q_(k-1) + q_(k+1)),  p_1 = q_1 + h/2 (2 q_0 + q_2),  p_0 = q_0 + h/2 q_1.
// With s = sqrt(1 - h^2) and r = h / (1 + s) all pivots of the elimination from behind are
// 1 - h r / 2 = h / (2 r):
//     q_k = a_k - r q_(k-1) (q_1 = a_1 - 2 r q_0),  a_k = (2 r / h) p_k - r a_(k+1),
// and q_0 = (p_0 - h/2 a_1) / s. |r| < 1: errors do not grow. Behind the degree n of the polynomial
// every quotient is (-r)^m (C_0 + C_1 m + C_2 m^2) at n + m: with
//     a_(n+m) = (2 r / h) sum over j of (-r)^j p_(n+m+j) = (-r)^m (C_0 + C_1 (m + g)) / s,
// g = r^2 / (1 - r^2), where C_2 is still zero, the next one's numbers are
//     q_n,  (C_0 + C_1 (g + 1/2)) / s,  C_1 / (2 s).
template <class D, class V = hn::Vec<D>>
HWY_NOINLINE void divide_by_width(D d, V h, std::size_t pole_order, std::size_t n, V* c) {
  const V one = hn::Set(d, 1.0), half = hn::Set(d, 0.5), half_h = hn::Mul(h, half);
  const V s = hn::Sqrt(hn::Mul(hn::Sub(one, h), hn::Add(one, h)));
  const V pivot = hn::Div(hn::Set(d, 2.0), hn::Add(one, s)), inverse = hn::Div(one, s);
  const V r = hn::Mul(half_h, pivot), minus = hn::Neg(r), square = hn::Mul(r, r);
  const V g = hn::Mul(square, hn::Mul(hn::MulAdd(half, s, half), inverse));
  const auto divide = [&](V a_n) HWY_ATTR {
    c[n] = a_n;
    for (std::size_t k = n; k-- > 1;) c[k] = hn::MulAdd(minus, c[k + 1], hn::Mul(pivot, c[k]));
    c[0] = hn::Mul(hn::NegMulAdd(half_h, c[1], c[0]), inverse);
    c[1] = hn::MulAdd(hn::Add(minus, minus), c[0], c[1]);
    for (std::size_t k = 2; k <= n; ++k) c[k] = hn::MulAdd(minus, c[k - 1], c[k]);
  };
  divide(hn::Mul(pivot, c[n]));
  V first = hn::Zero(d), second = first;  // C_1, C_2
  for (std::size_t order = 1; order < pole_order; ++order) {
    const V of_first = hn::Mul(first, inverse),
            a_n = hn::MulAdd(of_first, g, hn::Mul(c[n], inverse));
    divide(a_n);
    second = hn::Mul(half, of_first);
    first = hn::Add(a_n, second);
  }
  // two powers of -r at a time
  V power = minus, next = square;
  for (std::size_t k = n + 1; k <= kMostChebyshevDegree; ++k) {
    V value = c[n];
    if (pole_order > 1) {
      const V m = hn::Set(d, static_cast<double>(k - n));
      value = hn::MulAdd(m, hn::MulAdd(m, second, first), value);
    }
    c[k] = hn::Mul(power, value);
    const V after = hn::Mul(power, square);
    power = next;
    next = after;
  }
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
