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
// over (1 + h z)^pole_order, -1 < h < 1.
//
// With z T_k = (T_(k-1) + T_(k+1)) / 2 the coefficients of p = (1 + h z) q are
//     p_k = q_k + h/2 (q_(k-1) + q_(k+1)),  p_1 = q_1 + h/2 (2 q_0 + q_2),  p_0 = q_0 + h/2 q_1.
// Behind the degree of p those of q are a geometric series of ratio -r, r = h / (1 + s),
// s = sqrt(1 - h^2), so that all pivots of the elimination from behind are 1 - h r / 2 = h / (2 r):
//     q_k = a_k - r q_(k-1) (q_1 = a_1 - 2 r q_0),  a_k = (2 r / h) p_k - r a_(k+1),
// and q_0 = (p_0 - h/2 a_1) / s. |r| < 1: errors do not grow.
template <class D, class V = hn::Vec<D>>
HWY_NOINLINE void divide_by_width(D d, V h, std::size_t pole_order, std::size_t degree, V* c) {
  const V one = hn::Set(d, 1.0), half = hn::Mul(h, hn::Set(d, 0.5));
  const V s = hn::Sqrt(hn::Mul(hn::Sub(one, h), hn::Add(one, h)));
  const V pivot = hn::Div(hn::Set(d, 2.0), hn::Add(one, s)), inverse = hn::Div(one, s);
  const V r = hn::Mul(half, pivot);
  const V minus = hn::Neg(r);
  const auto divide = [&](std::size_t n) HWY_ATTR {
    c[n] = hn::Mul(pivot, c[n]);
    for (std::size_t k = n; k-- > 1;) c[k] = hn::MulAdd(minus, c[k + 1], hn::Mul(pivot, c[k]));
    c[0] = hn::Mul(hn::NegMulAdd(half, c[1], c[0]), inverse);
    c[1] = hn::MulAdd(hn::Add(minus, minus), c[0], c[1]);
    for (std::size_t k = 2; k <= n; ++k) c[k] = hn::MulAdd(minus, c[k - 1], c[k]);
  };
  divide(degree);
  for (std::size_t k = degree; k < kMostChebyshevDegree; ++k) c[k + 1] = hn::Mul(minus, c[k]);
  for (std::size_t n = 1; n < pole_order; ++n) divide(kMostChebyshevDegree);
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
