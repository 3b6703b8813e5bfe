// The inverse of trilinear maps along rays as power series, compiled once for every instruction
// set. Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_INVERSE_SERIES_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_INVERSE_SERIES_INL
#    undef HIAC_RENDER_INVERSE_SERIES_INL
#  else
#    define HIAC_RENDER_INVERSE_SERIES_INL
#  endif

#  include <array>
#  include <cstddef>

#  include <hwy/highway.h>

#  include "hiac/element/chebyshev_points.hpp"
#  include "hiac/element/cube_polynomial-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The preimages of points along rays under a trilinear map, as power series in the position z from
// -1 to 1. About the middle the map is
//     X = X_0 + J x + E x_0 x_1 + F x_0 x_2 + G x_1 x_2 + H x_0 x_1 x_2,
// with x the coordinates minus those of the middle. Along X = X_0 + z h the coefficients of x
// follow one after another: the first is J^-1 h, and J x_k follows from the products of the
// previous coefficients (the method of undetermined coefficients: D. E. Knuth, The Art of Computer
// Programming, vol. 2, section 4.7).
template <class D>
class InverseSeries {
 public:
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  enum class Outcome { converged, unfinished, hopeless };

  // Expands the series. `middle`: the coordinates at z = 0; `weight`: the weight of each
  // coordinate. The outcome is converged if in all lanes of `active` the last two coefficients are
  // below `accuracy`; it is hopeless if, extrapolated from the decay of the first few, even the
  // Chebyshev polynomial of kMostChebyshevDegree would miss 2^3 times that accuracy.
  HWY_NOINLINE Outcome expand(D d, const std::array<CubePolynomial, 3>& map,
                              const LanePoint<V>& middle, const LanePoint<V>& weight,
                              const V (&step)[3], V accuracy, M active) {
    weight_ = weight;
    start(d, map, middle, step);
    V before = largest(1), early = before;
    for (degree_ = 2; degree_ < kMostDegree; ++degree_) {
      append(d, degree_);
      const V last = largest(degree_), both = hn::Add(before, last);
      if (hn::AllTrue(d, hn::Or(hn::Not(active), hn::Le(both, accuracy))))
        return Outcome::converged;
      if (degree_ == kProbe / 2) early = both;
      if (degree_ == kProbe && !hn::AllFalse(d, hn::And(active, exceeds(d, early, both, accuracy))))
        return Outcome::hopeless;
      before = last;
    }
    --degree_;
    return Outcome::unfinished;
  }

  // Computes the coordinates at -z and z.
  HWY_INLINE void at(D d, double z, LanePoint<V>& front, LanePoint<V>& back) const {
    const V place = hn::Set(d, z), square = hn::Set(d, z * z);
    std::size_t k = degree_ & ~std::size_t{1};
    LanePoint<V> even = x_[k], odd = x_[k + 1];
    if (k == degree_) odd = {{hn::Zero(d), hn::Zero(d), hn::Zero(d)}};
    while (k > 0) {
      k -= 2;
      for (std::size_t a = 0; a < 3; ++a) {
        even.c[a] = hn::MulAdd(even.c[a], square, x_[k].c[a]);
        odd.c[a] = hn::MulAdd(odd.c[a], square, x_[k + 1].c[a]);
      }
    }
    for (std::size_t a = 0; a < 3; ++a) {
      front.c[a] = hn::NegMulAdd(place, odd.c[a], even.c[a]);
      back.c[a] = hn::MulAdd(place, odd.c[a], even.c[a]);
    }
  }

 private:
  static constexpr std::size_t kMostDegree = 24;  // of coefficients: degrees are below it
  static constexpr std::size_t kProbe = 8;

  // Whether Chebyshev coefficients of kMostChebyshevDegree would be too large, if the coefficients
  // of powers decay beyond kProbe as they did from half of it: T_n contains z^n with the factor
  // 2^(n-1).
  static HWY_INLINE M exceeds(D d, V early, V both, V accuracy) {
    const V rate = hn::Div(both, early);
    V left = both;
    for (std::size_t k = kProbe; k < kMostChebyshevDegree; k += kProbe / 2)
      left = hn::Mul(left, rate);
    constexpr double kLeading = std::size_t{1} << (kMostChebyshevDegree - 1);
    return hn::Gt(left, hn::Mul(hn::Set(d, 0x1p3 * kLeading), accuracy));
  }

  // Computes the coefficients of z^0 and z^1, and the constants for the following ones.
  HWY_INLINE void start(D d, const std::array<CubePolynomial, 3>& map, const LanePoint<V>& middle,
                        const V (&step)[3]) {
    JacobianSolver<V> solver;
    V bend[kProducts][3];
    for (std::size_t a = 0; a < 3; ++a) {
      V value;
      value_and_gradient<1>(d, map[a], middle, value, solver.row[a]);
      const auto c = [&](std::size_t k) { return hn::Set(d, map[a].c[k]); };
      bend[kUv][a] = hn::MulAdd(c(7), middle.c[2], c(3));
      bend[kUw][a] = hn::MulAdd(c(7), middle.c[1], c(5));
      bend[kVw][a] = hn::MulAdd(c(7), middle.c[0], c(6));
      bend[kUvw][a] = c(7);
    }
    solver.prepare(d);
    for (std::size_t p = 0; p < kProducts; ++p) bend_[p] = solver.solve(bend[p]);
    x_[0] = middle;
    x_[1] = solver.solve(step);
    vw_[1] = hn::Zero(d);
  }

  // Computes the coefficient of z^n.
  HWY_INLINE void append(D d, std::size_t n) {
    V uv = hn::Zero(d), uw = uv, vw = uv, uvw = uv;
    for (std::size_t k = 1; k < n; ++k) {
      const LanePoint<V>&x = x_[k], &rest = x_[n - k];
      uv = hn::MulAdd(x.c[0], rest.c[1], uv);
      uw = hn::MulAdd(x.c[0], rest.c[2], uw);
      vw = hn::MulAdd(x.c[1], rest.c[2], vw);
      uvw = hn::MulAdd(x.c[0], vw_[n - k], uvw);
    }
    vw_[n] = vw;
    for (std::size_t a = 0; a < 3; ++a) {
      const V sum =
          hn::MulAdd(bend_[kUv].c[a], uv,
                     hn::MulAdd(bend_[kUw].c[a], uw,
                                hn::MulAdd(bend_[kVw].c[a], vw, hn::Mul(bend_[kUvw].c[a], uvw))));
      x_[n].c[a] = hn::Neg(sum);
    }
  }

  [[nodiscard]] HWY_INLINE V largest(std::size_t k) const {
    const LanePoint<V>& x = x_[k];
    const auto size = [&](std::size_t a) { return hn::Abs(hn::Mul(weight_.c[a], x.c[a])); };
    return hn::Max(hn::Max(size(0), size(1)), size(2));
  }

  enum : std::size_t { kUv, kUw, kVw, kUvw, kProducts };

  LanePoint<V> bend_[kProducts];  // J^-1 E, J^-1 F, J^-1 G, J^-1 H
  LanePoint<V> weight_;
  std::size_t degree_ = 0;
  LanePoint<V> x_[kMostDegree];
  V vw_[kMostDegree];  // coefficients of x_1 x_2
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
