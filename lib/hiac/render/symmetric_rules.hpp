#pragma once

#include <array>
#include <cstddef>

namespace hiac {

/// Most nodes of the rules that integrals of many segments at a time are made with.
inline constexpr std::size_t kMostSymmetricNodes = 12;

/// A Gauss-Legendre rule for means over [-1, 1], its nodes in pairs -z and z: what is even or odd
/// in z is found once for both.
struct SymmetricRule {
  std::size_t pairs = 0;
  double middle = 0;  ///< weight of z = 0; 0 where that is no node
  std::array<double, kMostSymmetricNodes / 2> z{}, weight{};  ///< z > 0; the weight of either node
};

/// Those with 1, 2 .. kMostSymmetricNodes nodes.
using SymmetricRules = std::array<SymmetricRule, kMostSymmetricNodes>;
const SymmetricRules& symmetric_rules();

/// What an integrand p(z) exp(-A(z)) is on Bernstein ellipses about [-1, 1], by ellipse.
///
/// On the ellipse of parameter rho, |z| is at most a = (rho + 1/rho) / 2, |p| at most rho^degree
/// times its maximum on [-1, 1] (Bernstein's lemma), and |exp(-A)| at most
/// exp(sum of |alpha_k| a^k, k > 0) where A = sum of alpha_k z^k has no negative alpha_0. With M
/// the bound of their product the error of the mean by n nodes is at most (64/15) M rho^(-2n) / (1
/// - rho^-2) / 2 (Trefethen, "Approximation Theory and Approximation Practice", 2013,
/// theorem 19.3), so that what is allowed asks for
///     n >= rate (log(M / allowed) + log(32/15 / (1 - rho^-2))).
struct QuadraticEllipses {
  static constexpr std::size_t kCount = 8;
  using Row = std::array<double, kCount>;
  Row rate;                      ///< 1 / (2 log rho)
  std::array<Row, 2> constant;   ///< of n, for p of degree 1 and 2
  std::array<Row, 3> per_power;  ///< of n, for |alpha_1|, |alpha_2|, |alpha_3|
};
const QuadraticEllipses& quadratic_ellipses();

/// Which ellipse to try, and then which of its neighbours: the larger and the smaller one in turn.
struct EllipseChoice {
  std::size_t best = 3;
  bool larger = false;

  std::size_t neighbour() {
    larger = !larger;
    if (larger) return best + 1 < QuadraticEllipses::kCount ? best + 1 : best;
    return best > 0 ? best - 1 : best;
  }
};

}  // namespace hiac
