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

#  include "hiac/optics/bernstein.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A polynomial of z in [-1, 1] in every lane, in powers of z; all of one degree. Those that are
// interpolated have coefficients in powers that are small like their Chebyshev coefficients.
template <class V>
struct LanePolynomial {
  std::size_t degree = 0;
  V c[kMaxFieldDegree + 1];

  // Without what is not there: assignment would move all of them.
  HWY_INLINE void set(const LanePolynomial& other) {
    degree = other.degree;
    for (std::size_t k = 0; k <= degree; ++k) c[k] = other.c[k];
  }
};

// What is left of a polynomial on [middle - half, middle + half], as one on [-1, 1].
template <class D, class V = hn::Vec<D>>
HWY_INLINE void keep_part(D, LanePolynomial<V>& f, V middle, V half) {
  const std::size_t n = f.degree;
  for (std::size_t r = 0; r < n; ++r)
    for (std::size_t k = n; k-- > r;) f.c[k] = hn::MulAdd(middle, f.c[k + 1], f.c[k]);
  V scale = half;
  for (std::size_t k = 1; k <= n; ++k) {
    f.c[k] = hn::Mul(f.c[k], scale);
    scale = hn::Mul(scale, half);
  }
}

// What of a polynomial in powers of z is even, and what is odd over z, by z^2.
template <class V>
struct EvenAndOdd {
  V even, odd;
};
template <class D, class V = hn::Vec<D>>
HWY_INLINE EvenAndOdd<V> even_and_odd(D d, const V* c, std::size_t degree, V square) {
  std::size_t k = degree & ~std::size_t{1};
  EvenAndOdd<V> at{c[k], k < degree ? c[k + 1] : hn::Zero(d)};
  while (k > 0) {
    k -= 2;
    at.even = hn::MulAdd(at.even, square, c[k]);
    at.odd = hn::MulAdd(at.odd, square, c[k + 1]);
  }
  return at;
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
