#pragma once

#include <array>
#include <cstddef>

namespace hiac {

inline constexpr std::size_t kMostQuadraticNodes = 12;

/// The Gauss-Legendre rule with some nodes, on [0, 1].
struct QuadraticRule {
  std::size_t count;
  std::array<double, kMostQuadraticNodes> x, w;
};

/// 1 <= nodes <= kMostQuadraticNodes.
const QuadraticRule& quadratic_rule(std::size_t nodes);

/// How many nodes integrate p(x) exp(-A(x)) over [0, 1] with an error of at most what is allowed;
/// 0 when more than kMostQuadraticNodes.
///
/// p is a polynomial of degree `degree` and |p| at most `wanted` times the allowed error on [0, 1];
/// A is a cubic that is nowhere negative there, c1, c2 and c3 the magnitudes of its Chebyshev
/// coefficients. On the Bernstein ellipse of parameter rho, |p| is at most rho^degree times as
/// large (Bernstein's lemma), and |exp(-A)| at most exp(sum c_k (rho^k + rho^-k) / 2), as A's mean
/// c0 is not negative; with M their product the error of n nodes is at most (64/15) M rho^(-2n) /
/// (1 - rho^-2) / 2 (Trefethen, "Approximation Theory and Approximation Practice", 2013,
/// theorem 19.3).
std::size_t quadratic_nodes(std::size_t degree, double wanted, double c1, double c2, double c3);

}  // namespace hiac
