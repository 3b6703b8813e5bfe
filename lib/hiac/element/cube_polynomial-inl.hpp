// Polynomials of three coordinates and their gradients in every lane, compiled once for every
// instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_CUBE_POLYNOMIAL_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_CUBE_POLYNOMIAL_INL
#    undef HIAC_RENDER_CUBE_POLYNOMIAL_INL
#  else
#    define HIAC_RENDER_CUBE_POLYNOMIAL_INL
#  endif

#  include <type_traits>

#  include <hwy/highway.h>

#  include "hiac/element/cell_polynomials.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct LanePoint {
  V c[3];
};

// The number of powers of u in the coefficient of v^j w^k of a shape's fields of order P: those
// that occur in shape functions (checked by cube_polynomial_test.cpp).
constexpr std::size_t terms_of_u(CellShape shape, std::size_t P, std::size_t j, std::size_t k) {
  switch (shape) {
    case CellShape::tetrahedron:
      return j <= k ? j + 1 : 0;
    case CellShape::pyramid:
      if (j > k) return 0;
      if (k < P) return k + 1;
      return j < 2 ? P + 1 : P + 2 - j;
    case CellShape::prism:
      return k < 2 || j < 2 ? j + 1 : 0;
    case CellShape::wedge:
      return j + k > P + 1 ? 0 : j + k < P ? j + k + 1 : P + 1;
    case CellShape::brick:
      break;
  }
  return (j < 2 && k < 2) ? P + 1 : (j < 2 || k < 2) ? 2 : 0;
}

// The value of a polynomial of kTerms coefficients, by Horner's rule.
template <std::size_t kTerms, class D, class V = hn::Vec<D>>
HWY_INLINE V line_of(D d, const double* c, V u) {
  V line = hn::Set(d, c[kTerms - 1]);
  for (std::size_t i = kTerms - 1; i-- > 0;) line = hn::MulAdd(line, u, hn::Set(d, c[i]));
  return line;
}

// The coefficient of w^K in a cube polynomial of a shape's field.
template <std::size_t P, CellShape kShape, std::size_t K, class D, class V = hn::Vec<D>>
HWY_INLINE V plane_of(D d, const CubePolynomial& f, const LanePoint<V>& at) {
  constexpr std::size_t kTop = [] {
    std::size_t top = P;
    while (terms_of_u(kShape, P, top, K) == 0) --top;
    return top;
  }();
  const double* c = f.c.data() + K * (P + 1) * (P + 1);
  V plane = line_of<terms_of_u(kShape, P, kTop, K)>(d, c + kTop * (P + 1), at.c[0]);
  const auto add = [&]<std::size_t J>(std::integral_constant<std::size_t, J>) HWY_ATTR {
    const V line = line_of<terms_of_u(kShape, P, J, K)>(d, c + J * (P + 1), at.c[0]);
    plane = hn::MulAdd(plane, at.c[1], line);
  };
  if constexpr (kTop > 2) add(std::integral_constant<std::size_t, 2>());
  if constexpr (kTop > 1) add(std::integral_constant<std::size_t, 1>());
  if constexpr (kTop > 0) add(std::integral_constant<std::size_t, 0>());
  return plane;
}

// The value of a field of order P, by Horner's rule.
template <std::size_t P, CellShape kShape, class D, class V = hn::Vec<D>>
HWY_INLINE V value_of(D d, const CubePolynomial& f, const LanePoint<V>& at) {
  V sum = plane_of<P, kShape, P>(d, f, at);
  if constexpr (P > 2) sum = hn::MulAdd(sum, at.c[2], plane_of<P, kShape, 2>(d, f, at));
  if constexpr (P > 1) sum = hn::MulAdd(sum, at.c[2], plane_of<P, kShape, 1>(d, f, at));
  return hn::MulAdd(sum, at.c[2], plane_of<P, kShape, 0>(d, f, at));
}

// Computes the value and the gradient of a polynomial.
template <std::size_t P, class D, class V = hn::Vec<D>>
HWY_INLINE void value_and_gradient(D d, const CubePolynomial& f, const LanePoint<V>& at, V& value,
                                   V (&gradient)[3]) {
  constexpr std::size_t kN = P + 1;
  const V u = at.c[0], v = at.c[1], w = at.c[2];
  if constexpr (P == 1) {  // the usual case for maps
    const auto along_u = [&](std::size_t k) {
      return hn::MulAdd(hn::Set(d, f.c[k + 1]), u, hn::Set(d, f.c[k]));
    };
    const auto slope = [&](std::size_t k) {
      return hn::MulAdd(hn::Set(d, f.c[k + 5]), w, hn::Set(d, f.c[k + 1]));
    };
    const V by_vw = along_u(6), by_w = along_u(4);
    gradient[0] = hn::MulAdd(slope(2), v, slope(0));
    gradient[1] = hn::MulAdd(by_vw, w, along_u(2));
    gradient[2] = hn::MulAdd(by_vw, v, by_w);
    value = hn::MulAdd(gradient[1], v, hn::MulAdd(by_w, w, along_u(0)));
    return;
  }
  const V zero = hn::Zero(d);
  value = gradient[0] = gradient[1] = gradient[2] = zero;
  for (std::size_t k = kN; k-- > 0;) {
    V plane = zero, by_u = zero, by_v = zero;
    for (std::size_t j = kN; j-- > 0;) {
      const double* c = f.c.data() + (k * kN + j) * kN;
      V line = hn::Set(d, c[P]), slope = zero;
      for (std::size_t i = P; i-- > 0;) {
        slope = i + 1 == P ? line : hn::MulAdd(slope, u, line);
        line = hn::MulAdd(line, u, hn::Set(d, c[i]));
      }
      by_v = hn::MulAdd(by_v, v, plane);
      plane = hn::MulAdd(plane, v, line);
      by_u = hn::MulAdd(by_u, v, slope);
    }
    gradient[2] = hn::MulAdd(gradient[2], w, value);
    value = hn::MulAdd(value, w, plane);
    gradient[0] = hn::MulAdd(gradient[0], w, by_u);
    gradient[1] = hn::MulAdd(gradient[1], w, by_v);
  }
}

// Solves linear systems of a Jacobian whose rows are r_0, r_1, r_2: with r_1 x r_2 the solution of
// J x = b is (b_0 r_1 x r_2 + r_0 x (b_2 r_1 - b_1 r_2)) / det J.
template <class V>
struct JacobianSolver {
  V row[3][3];

  template <class D>
  HWY_INLINE void prepare(D d) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      normal_[i] = hn::MulSub(row[1][j], row[2][k], hn::Mul(row[1][k], row[2][j]));
    }
    const V det = hn::MulAdd(row[0][0], normal_[0],
                             hn::MulAdd(row[0][1], normal_[1], hn::Mul(row[0][2], normal_[2])));
    scale_ = hn::Div(hn::Set(d, 1.0), det);
  }

  [[nodiscard]] HWY_INLINE LanePoint<V> solve(const V (&b)[3]) const {
    V rest[3];
    for (std::size_t i = 0; i < 3; ++i)
      rest[i] = hn::MulSub(b[2], row[1][i], hn::Mul(b[1], row[2][i]));
    LanePoint<V> x;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      const V across = hn::MulSub(row[0][j], rest[k], hn::Mul(row[0][k], rest[j]));
      x.c[i] = hn::Mul(hn::MulAdd(b[0], normal_[i], across), scale_);
    }
    return x;
  }

 private:
  V normal_[3], scale_;
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
