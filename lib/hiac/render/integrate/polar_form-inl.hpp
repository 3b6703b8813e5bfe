// Polar forms of fields in tetrahedra of order 2 and 3, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_POLAR_FORM_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_POLAR_FORM_INL
#    undef HIAC_RENDER_POLAR_FORM_INL
#  else
#    define HIAC_RENDER_POLAR_FORM_INL
#  endif

#  include <algorithm>
#  include <array>
#  include <cstddef>
#  include <cstdint>

#  include <hwy/highway.h>

#  include "hiac/mesh/interpolant_range.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A scalar along a ray, u in [0, 1]: sum of c_k binomial(n, k) u^k (1-u)^(n-k).
template <class V, std::size_t kDegree>
struct BernsteinScalar {
  V c[kDegree + 1];
};

// The polar form of a field in a tetrahedron. It has as many arguments as the order, is symmetric
// and affine in each argument, and equals the field if all arguments are equal (L. Ramshaw,
// "Blossoms are polar forms", 1989). With the Bernstein coefficients b, where that of the first
// corner is 0, and barycentric coordinates p, q, r it is sum b_ij p_i q_j for order 2 and sum b_ijk
// p_i q_j r_k for order 3. On the segment from p to q the field's Bernstein coefficients are the
// form's values at p .. p q .. q.
//
// Below, the first barycentric coordinate is eliminated. Values are given at the kind's nodes;
// corner[i] is the node that serves as the i-th corner here.
template <std::size_t kOrder>
class PolarForm;

// sum linear_i (p_i + q_i) + sum square_ij p_i q_j.
template <>
class PolarForm<2> {
 public:
  static constexpr std::size_t kNodes = 10;

  // Returns between which numbers the field lies.
  HWY_INLINE ValueRange set(const std::array<double, kNodes>& value,
                            const std::array<std::size_t, 4>& corner) {
    // the node between two corners
    static constexpr std::array<std::array<std::uint8_t, 4>, 4> kBetween{
        {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3}}};
    std::array<std::array<double, 4>, 4> b;  // indexed by two corners
    for (std::size_t i = 0; i < 4; ++i) b[i][i] = value[corner[i]];
    ValueRange range{0, 0};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double middle = value[kBetween[corner[i]][corner[j]]];
        b[i][j] = b[j][i] = 2 * middle - 0.5 * (b[i][i] + b[j][j]);
        range = {std::min({range.least, b[i][j], b[i][i]}),
                 std::max({range.most, b[i][j], b[i][i]})};
      }
    for (std::size_t i = 0; i < 3; ++i) {
      linear_[i] = b[0][i + 1];
      for (std::size_t j = 0; j < 3; ++j)
        square_[i][j] = b[i + 1][j + 1] - b[0][i + 1] - b[0][j + 1];
    }
    return range;
  }

  // The field from p to q: barycentric coordinates of the last three corners.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE BernsteinScalar<V, 2> between(D d, const V (&p)[3], const V (&q)[3]) const {
    const V zero = hn::Zero(d);
    V pp = zero, pq = zero, qq = zero;
    for (std::size_t i = 0; i < 3; ++i) {
      const V linear = hn::Set(d, linear_[i]);
      V at_p = linear, at_q = linear;
      for (std::size_t j = 0; j < 3; ++j) {
        const V square = hn::Set(d, square_[i][j]);
        at_p = hn::MulAdd(square, p[j], at_p);
        at_q = hn::MulAdd(square, q[j], at_q);
      }
      pp = hn::MulAdd(hn::Add(at_p, linear), p[i], pp);
      pq = hn::MulAdd(linear, p[i], hn::MulAdd(at_p, q[i], pq));
      qq = hn::MulAdd(hn::Add(at_q, linear), q[i], qq);
    }
    return {{pp, pq, qq}};
  }

 private:
  std::array<double, 3> linear_;
  std::array<std::array<double, 3>, 3> square_;
};

// sum linear_i (p_i + q_i + r_i) + sum square_ij (p_i q_j + p_i r_j + q_i r_j)
// + sum cube_ijk p_i q_j r_k.
template <>
class PolarForm<3> {
 public:
  static constexpr std::size_t kNodes = 20;

  // Returns between which numbers the field lies.
  HWY_INLINE ValueRange set(const std::array<double, kNodes>& value,
                            const std::array<std::size_t, 4>& corner) {
    // the node on the edge between two corners, near the first one, and the node of the face
    // opposite a corner
    static constexpr std::array<std::array<std::uint8_t, 4>, 4> kNear{
        {{0, 4, 9, 10}, {5, 1, 6, 12}, {8, 7, 2, 14}, {11, 13, 15, 3}}};
    static constexpr std::array<std::uint8_t, 4> kOpposite{17, 18, 16, 19};
    ValueRange range{0, 0};
    const auto kept = [&](double c) {
      range = {std::min(range.least, c), std::max(range.most, c)};
      return c;
    };
    // coefficients b_iii, b_iij, and that of the three indices other than k
    std::array<double, 4> at, but;
    std::array<std::array<double, 4>, 4> toward;
    for (std::size_t i = 0; i < 4; ++i) at[i] = kept(value[corner[i]]);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        if (i == j) continue;
        const double near = value[kNear[corner[i]][corner[j]]],
                     far = value[kNear[corner[j]][corner[i]]];
        toward[i][j] = kept((18 * near - 9 * far - 5 * at[i] + 2 * at[j]) / 6);
      }
    for (std::size_t k = 0; k < 4; ++k) {
      double others = 0;
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
          if (i != k && j != k) others += i == j ? at[i] : 3 * toward[i][j];
      but[k] = kept((27 * value[kOpposite[corner[k]]] - others) / 6);
    }
    eliminate(at, toward, but);
    return range;
  }

  // The field from p to q: barycentric coordinates of the last three corners.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE BernsteinScalar<V, 3> between(D d, const V (&p)[3], const V (&q)[3]) const {
    V by_p[3], by_q[3];
    const V pp = along(d, p, by_p), qq = along(d, q, by_q);
    BernsteinScalar<V, 3> f{{pp, pp, qq, qq}};
    for (std::size_t i = 0; i < 3; ++i) {
      f.c[0] = hn::MulAdd(by_p[i], p[i], f.c[0]);
      f.c[1] = hn::MulAdd(by_p[i], q[i], f.c[1]);
      f.c[2] = hn::MulAdd(by_q[i], p[i], f.c[2]);
      f.c[3] = hn::MulAdd(by_q[i], q[i], f.c[3]);
    }
    return f;
  }

 private:
  static constexpr std::size_t kPairs = 6;  // of indices i <= j
  static constexpr std::array<std::array<std::size_t, 3>, 3> kPair{
      {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}}};

  HWY_INLINE void eliminate(const std::array<double, 4>& at,
                            const std::array<std::array<double, 4>, 4>& toward,
                            const std::array<double, 4>& but) {
    for (std::size_t i = 0; i < 3; ++i) linear_[i] = toward[0][i + 1];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j)
        square_[kPair[i][j]] =
            (i == j ? toward[i + 1][0] : but[4 - i - j]) - linear_[i] - linear_[j];
    const auto coefficient = [&](std::size_t i, std::size_t j, std::size_t k) {
      if (i == j) return j == k ? at[i + 1] : toward[i + 1][k + 1];
      if (i == k) return toward[i + 1][j + 1];
      return j == k ? toward[j + 1][i + 1] : but[0];
    };
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k)
          cube_[kPair[i][j]][k] = coefficient(i, j, k) - square_[kPair[i][j]] -
                                  square_[kPair[i][k]] - square_[kPair[j][k]] -
                                  (linear_[i] + linear_[j] + linear_[k]);
  }

  // Returns the constant part of the form at (p, p, x), whose value is that constant + sum of
  // by_x[i] x_i.
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE V along(D d, const V (&p)[3], V (&by_x)[3]) const {
    V square[kPairs], twice[kPairs];
    for (std::size_t pair = 0; pair < kPairs; ++pair) {
      square[pair] = hn::Set(d, square_[pair]);
      twice[pair] = hn::Add(square[pair], square[pair]);
      for (std::size_t k = 0; k < 3; ++k)
        twice[pair] = hn::MulAdd(hn::Set(d, cube_[pair][k]), p[k], twice[pair]);
    }
    V rest = hn::Zero(d);
    for (std::size_t i = 0; i < 3; ++i) {
      const V linear = hn::Set(d, linear_[i]);
      V at_p = hn::Add(linear, linear);
      by_x[i] = linear;
      for (std::size_t j = 0; j < 3; ++j) {
        at_p = hn::MulAdd(square[kPair[i][j]], p[j], at_p);
        by_x[i] = hn::MulAdd(twice[kPair[i][j]], p[j], by_x[i]);
      }
      rest = hn::MulAdd(at_p, p[i], rest);
    }
    return rest;
  }

  std::array<double, 3> linear_;
  std::array<double, kPairs> square_;
  std::array<std::array<double, 3>, kPairs> cube_;
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
