// Polynomials of one variable in every lane, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_LANE_POLYNOMIAL_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_LANE_POLYNOMIAL_INL
#    undef HIAC_RENDER_LANE_POLYNOMIAL_INL
#  else
#    define HIAC_RENDER_LANE_POLYNOMIAL_INL
#  endif

#  include <cstddef>

#  include <hwy/highway.h>

#  include "hiac/element/chebyshev_points.hpp"
#  include "hiac/optics/bernstein.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A polynomial of z in [-1, 1] in every lane, in powers of z; all lanes have the same degree. The
// coefficients of interpolated polynomials decay like their Chebyshev coefficients.
template <class V>
struct LanePolynomial {
  std::size_t degree = 0;
  V c[kMaxFieldDegree + 1];
};

// Computes the polynomial of degree n with given values at the n + 1 Chebyshev points; `value` is
// overwritten.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void powers_from_points(D d, const ChebyshevPoints& points, std::size_t n, V* value,
                                   V* c) {
  // even powers depend on the sums of values at opposite points, odd powers on their differences
  const std::size_t pairs = (n + 1) / 2;
  for (std::size_t j = 0; j < pairs; ++j) {
    const V front = value[j], back = value[n - j];
    value[j] = hn::Add(back, front);
    value[n - j] = hn::Sub(back, front);
  }
  for (std::size_t k = 0; k <= n; ++k) {
    V sum = hn::Zero(d);
    if (k % 2 == 0) {
      for (std::size_t j = 0; 2 * j <= n; ++j)
        sum = hn::MulAdd(hn::Set(d, points.power(k, j)), value[j], sum);
    } else {
      for (std::size_t j = 0; j < pairs; ++j)
        sum = hn::MulAdd(hn::Set(d, points.power(k, n - j)), value[n - j], sum);
    }
    c[k] = sum;
  }
}

// Performs kSteps steps, from step `r` on, of Horner's scheme for the coefficients about another
// point: each step adds `by` times the next coefficient to those of r and above, the highest first.
// The steps are interleaved, so that every coefficient is loaded and stored once.
template <std::size_t kSteps, class V>
HWY_INLINE void shift_steps(V by, V* c, std::size_t degree, std::size_t r) {
  V next[kSteps];
  for (V& v : next) v = c[degree];
  for (std::size_t k = degree; k-- > r + kSteps - 1;) {
    V v = c[k];
    for (std::size_t i = 0; i < kSteps; ++i) next[i] = v = hn::MulAdd(by, next[i], v);
    c[k] = v;
  }
  for (std::size_t left = kSteps - 1; left > 0; --left) {
    V v = c[r + left - 1];
    for (std::size_t i = 0; i < left; ++i) next[i] = v = hn::MulAdd(by, next[i], v);
    c[r + left - 1] = v;
  }
}

// Restricts a polynomial to [middle - half, middle + half], mapped to [-1, 1].
template <class D, class V = hn::Vec<D>>
HWY_INLINE void keep_part(D, LanePolynomial<V>& f, V middle, V half) {
  const std::size_t n = f.degree;
  std::size_t r = 0;
  for (; r + 4 <= n; r += 4) shift_steps<4>(middle, f.c, n, r);
  for (; r < n; ++r) shift_steps<1>(middle, f.c, n, r);
  V scale = half;
  for (std::size_t k = 1; k <= n; ++k) {
    f.c[k] = hn::Mul(f.c[k], scale);
    scale = hn::Mul(scale, half);
  }
}

// The even part of a polynomial in powers of z, and its odd part divided by z, both evaluated from
// z^2.
template <class V>
struct EvenAndOdd {
  V even, odd;
};
// Evaluates both parts from the coefficients up to that of z^(2 kTop + 1), padded with zeros.
template <std::size_t kTop, class V>
HWY_INLINE EvenAndOdd<V> even_and_odd(const V* c, V square) {
  EvenAndOdd<V> at{c[2 * kTop], c[2 * kTop + 1]};
  for (std::size_t k = kTop; k-- > 0;) {
    at.even = hn::MulAdd(at.even, square, c[2 * k]);
    at.odd = hn::MulAdd(at.odd, square, c[2 * k + 1]);
  }
  return at;
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
