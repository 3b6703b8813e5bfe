// Polynomials close to rational functions in every lane, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_QUOTIENT_POWERS_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_QUOTIENT_POWERS_INL
#    undef HIAC_RENDER_QUOTIENT_POWERS_INL
#  else
#    define HIAC_RENDER_QUOTIENT_POWERS_INL
#  endif

#  include <cstddef>

#  include <hwy/highway.h>

#  include "hiac/element/chebyshev_points.hpp"
#  include "hiac/element/lane_polynomial-inl.hpp"
#  include "hiac/element/taper-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Approximates f(z) = P(z) / (1 + h z)^p, P of degree d and -1 < h < 1, on [-1, 1] by
//     Q = (P - T_m L) / (1 + h z)^p,
// where L, of degree less than p, makes the division exact: L agrees with P / T_m at the pole
// z = -1/h in its first p Taylor coefficients. Q is of degree m - 1, m >= d, and its error is
// T_m L / (1 + h z)^p.
//
// With s = -h z, s = 1 at the pole, and r and g of Taper,
//     P = h^-d sum of e_k s^k,  e_k = (-1)^k h^(d-k) p_k,
//     T_m = (-1)^m T_m(1/h) (1 + t_1 (s - 1) + t_2 (s - 1)^2 + ...),  T_m(1/h) = (r^m + r^-m) / 2,
//     t_1 = m g (1 - r^2m) / (1 + r^2m),  t_2 = g^2 (m^2 - t_1) / 2,
// the last by Chebyshev's differential equation; L = a_0 + a_1 (s - 1) + a_2 (s - 1)^2 is the
// quotient of both series. As 1 - s is at least 1 - |h|, the error of Q is at most the sum of
// |a_i| / (1 - |h|)^(p-i). Its coefficients in powers are computed from the lowest one on, which is
// stable: each step subtracts h times the previous coefficient, |h| < 1, p times over.
template <std::size_t p, std::size_t d, class D, class V = hn::Vec<D>>
class QuotientPowers {
 public:
  // Degrees of Q are even: m is odd.
  static constexpr std::size_t kMostM = kMostChebyshevDegree + 1;
  static_assert(kMostM % 2 == 1);

  // `points`: those of degree d. `taper`: no taper in inactive lanes.
  QuotientPowers(D tag, const ChebyshevPoints& points, const Taper<D>& taper)
      : tag_(tag), points_(points), taper_(taper), square_(hn::Mul(taper.r, taper.r)) {
    // 2 (r / h)^d, with the sign of (-1)^(m-d)
    const V half = hn::Set(tag, 0.5);
    scale_ = power_of<d>(hn::MulAdd(square_, half, half));
    scale_ = hn::Add(scale_, scale_);
    if constexpr (d % 2 == 0) scale_ = hn::Neg(scale_);
  }

  // Computes Q, from the values of f at the Chebyshev points of degree d, with the smallest m for
  // which its error is at most `negligible` in all lanes of `active`. Returns false if m would have
  // to exceed kMostM; the lanes concerned are removed from `active`.
  HWY_NOINLINE bool expand(const V* values, V negligible, hn::Mask<D>& active,
                           LanePolynomial<V>& q) const {
    V numerator[d + 1];
    numerator_powers(values, numerator);
    V b[p];
    about_pole(numerator, b);
    // r^(m-d)
    V power = d % 2 == 0 ? taper_.r : hn::Set(tag_, 1.0);
    for (std::size_t m = d + 1 - d % 2;; m += 2) {
      const auto near =
          hn::Le(hn::Mul(hn::Abs(power), bound(static_cast<double>(m), b)), negligible);
      if (hn::AllTrue(tag_, hn::Or(hn::Not(active), near))) {
        divide(numerator, m, power, b, q);
        return true;
      }
      if (m == kMostM) {
        active = hn::And(active, near);
        return false;
      }
      power = hn::Mul(power, square_);
    }
  }

 private:
  // Computes the coefficients of P in powers of z.
  HWY_INLINE void numerator_powers(const V* values, V* powers) const {
    const V one = hn::Set(tag_, 1.0);
    V value[d + 1];
    for (std::size_t j = 0; j <= d; ++j) {
      const V width = hn::MulAdd(taper_.h, hn::Set(tag_, 2 * points_.place(j) - 1), one);
      value[j] = hn::Mul(values[j], width);
      for (std::size_t k = 1; k < p; ++k) value[j] = hn::Mul(value[j], width);
    }
    powers_from_points(tag_, points_, d, value, powers);
  }

  // Computes the Taylor coefficients at s = 1 of the sum of e_k s^k times scale_, without the
  // factor (-1)^m r^(m-d).
  HWY_INLINE void about_pole(const V* numerator, V (&b)[p]) const {
    V power = scale_;
    for (V& v : b) v = hn::Zero(tag_);
    for (std::size_t k = d + 1; k-- > 0;) {
      const V e = hn::Mul(numerator[k], power);
      const auto order = static_cast<double>(k);
      b[0] = hn::Add(b[0], e);
      if constexpr (p > 1) b[1] = hn::MulAdd(e, hn::Set(tag_, order), b[1]);
      if constexpr (p > 2) b[2] = hn::MulAdd(e, hn::Set(tag_, order * (order - 1) / 2), b[2]);
      power = hn::Neg(hn::Mul(power, taper_.h));
    }
  }

  // Computes L: the quotient of the series whose first coefficients are `b` and 1, t_1, t_2.
  HWY_INLINE void quotient(double m, V t1, const V (&b)[p], V (&a)[p]) const {
    a[0] = b[0];
    if constexpr (p > 1) a[1] = hn::NegMulAdd(b[0], t1, b[1]);
    if constexpr (p > 2) {
      const V half = hn::Set(tag_, 0.5);
      const V t2 =
          hn::Mul(hn::Mul(taper_.g, taper_.g), hn::Mul(hn::Sub(hn::Set(tag_, m * m), t1), half));
      a[2] = hn::NegMulAdd(a[1], t1, hn::NegMulAdd(b[0], t2, b[2]));
    }
  }

  // A bound of the error of Q, divided by r^(m-d); r^2m is negligible in it.
  [[nodiscard]] HWY_INLINE V bound(double m, const V (&b)[p]) const {
    V a[p];
    quotient(m, hn::Mul(hn::Set(tag_, m), taper_.g), b, a);
    V off = hn::Mul(hn::Abs(a[0]), taper_.inverse_gap);
    for (std::size_t i = 1; i < p; ++i)
      off = hn::Mul(hn::Add(off, hn::Abs(a[i])), taper_.inverse_gap);
    return off;
  }

  // Computes Q. `power`: r^(m-d).
  HWY_INLINE void divide(const V* numerator, std::size_t m, V power, const V (&b)[p],
                         LanePolynomial<V>& q) const {
    // with x = r^2m, uses 1 - x for 1 / (1 + x): the error of Q is far larger than that of this
    const V one = hn::Set(tag_, 1.0), fallen = hn::Mul(power, power_of<d>(taper_.r));
    const V rest = hn::NegMulAdd(fallen, fallen, one), scale = hn::Mul(power, rest);
    const auto count = static_cast<double>(m);
    V a[p];
    quotient(count, hn::Mul(hn::Mul(hn::Set(tag_, count), taper_.g), hn::Mul(rest, rest)), b, a);
    // L in powers of z
    V line[3];
    line[0] = a[0];
    if constexpr (p > 1) {
      line[0] = hn::Sub(a[0], a[1]);
      line[1] = hn::Neg(hn::Mul(taper_.h, a[1]));
    }
    if constexpr (p > 2) {
      line[0] = hn::Add(line[0], a[2]);
      line[1] = hn::Mul(taper_.h, hn::Sub(hn::Add(a[2], a[2]), a[1]));
      line[2] = hn::Mul(hn::Mul(taper_.h, taper_.h), a[2]);
    }
    for (std::size_t i = 0; i < p; ++i) line[i] = hn::Mul(line[i], scale);
    // T_m is odd: even and odd powers of T_m L have different terms
    const auto& chebyshev = chebyshev_powers()[m];
    V before[p];
    for (V& v : before) v = hn::Zero(tag_);
    q.degree = m - 1;
    const auto add = [&](std::size_t k, V v) HWY_ATTR {
      for (V& part : before) part = v = hn::NegMulAdd(taper_.h, part, v);
      q.c[k] = v;
    };
    const auto add_even = [&](std::size_t k, V v) HWY_ATTR {
      if constexpr (p > 1)
        v = hn::NegMulAdd(hn::Set(tag_, k > 0 ? chebyshev[k - 1] : 0), line[1], v);
      add(k, v);
    };
    const auto add_odd = [&](std::size_t k, V v) HWY_ATTR {
      v = hn::NegMulAdd(hn::Set(tag_, chebyshev[k]), line[0], v);
      if constexpr (p > 2)
        v = hn::NegMulAdd(hn::Set(tag_, k > 1 ? chebyshev[k - 2] : 0), line[2], v);
      add(k, v);
    };
    // m - 1 >= d - d % 2
    add_even(0, numerator[0]);
    constexpr std::size_t kPairs = d / 2;
    for (std::size_t k = 1; k < 2 * kPairs; k += 2) {
      add_odd(k, numerator[k]);
      add_even(k + 1, numerator[k + 1]);
    }
    for (std::size_t k = 2 * kPairs + 1; k < m; k += 2) {
      add_odd(k, d % 2 == 1 && k == d ? numerator[d] : hn::Zero(tag_));
      add_even(k + 1, hn::Zero(tag_));
    }
  }

  template <std::size_t n>
  static HWY_INLINE V power_of(V x) {
    if constexpr (n == 1)
      return x;
    else if constexpr (n % 2 == 0)
      return power_of<n / 2>(hn::Mul(x, x));
    else
      return hn::Mul(x, power_of<n - 1>(x));
  }

  D tag_;
  const ChebyshevPoints& points_;
  Taper<D> taper_;
  V square_, scale_;  // r^2
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
