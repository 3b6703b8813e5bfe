#pragma once

#include <array>
#include <cstddef>

namespace hiac {

/// The largest number of nodes of the rules that integrate many segments at a time.
inline constexpr std::size_t kMostSymmetricNodes = 12;

/// A Gauss-Legendre rule for means over [-1, 1], its nodes in pairs -z and z: the even and odd
/// parts of a polynomial are evaluated once for both.
struct SymmetricRule {
  std::size_t pairs = 0;
  double middle = 0;  ///< weight of z = 0; 0 if that is not a node
  std::array<double, kMostSymmetricNodes / 2> z{}, weight{};  ///< z > 0; the weight of either node
};

/// The rules with 1, 2 .. kMostSymmetricNodes nodes.
using SymmetricRules = std::array<SymmetricRule, kMostSymmetricNodes>;
const SymmetricRules& symmetric_rules();

/// Bernstein ellipses about [-1, 1], on which integrands p(z) exp(-A(z)) are bounded.
///
/// On the ellipse of parameter rho, |z| is at most `reach`, so that |exp(-A)| is at most
/// exp(-alpha_0 + sum of |alpha_k| reach^k, k > 0) where A = sum of alpha_k z^k. With M the bound
/// of the integrand, the error of the mean by n nodes is at most (64/15) M rho^(-2n) / (1 - rho^-2)
/// / 2 (Trefethen, "Approximation Theory and Approximation Practice", 2013, theorem 19.3), so that
/// an allowed error requires n >= rate (log(M / allowed) + log_factor).
struct BernsteinEllipses {
  static constexpr std::size_t kCount = 8;
  using Row = std::array<double, kCount>;
  Row reach;       ///< (rho + 1/rho) / 2
  Row rate;        ///< 1 / (2 log rho)
  Row log_factor;  ///< log(32/15 / (1 - rho^-2))
};
const BernsteinEllipses& bernstein_ellipses();

/// Which ellipse to try first, and which of its neighbours next: the larger and the smaller one by
/// turns.
struct EllipseChoice {
  std::size_t best = 3;
  bool larger = false;

  std::size_t neighbour() {
    larger = !larger;
    if (larger) return best + 1 < BernsteinEllipses::kCount ? best + 1 : best;
    return best > 0 ? best - 1 : best;
  }
};

}  // namespace hiac
