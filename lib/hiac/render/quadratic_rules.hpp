#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

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
inline std::size_t quadratic_nodes(double degree, double wanted, double c1, double c2, double c3) {
  constexpr double kLog2 = 0.6931471805599454;  // rounded up
  constexpr double kFactor = 0.8223;            // log(32/15 / (1 - rho^-2)), rho >= 4
  constexpr std::array<double, 4> kRho{4, 16, 64, 256};
  if (!(wanted < 1e300)) return 0;
  // the power of two above
  const auto exponent =
      static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(wanted) >> 52) - 1022;
  const double log_front = kLog2 * static_cast<double>(exponent) + kFactor;
  double fewest = static_cast<double>(kMostQuadraticNodes) + 1;
  for (std::size_t k = 0; k < kRho.size(); ++k) {
    const double rho = kRho[k], inverse = 1 / rho, log_rho = 2 * kLog2 * static_cast<double>(k + 1);
    const double grown = 0.5 * (c1 * (rho + inverse) + c2 * (rho * rho + inverse * inverse) +
                                c3 * (rho * rho * rho + inverse * inverse * inverse));
    fewest = std::min(fewest, (log_front + grown + degree * log_rho) * (0.5 / log_rho));
  }
  if (!(fewest <= static_cast<double>(kMostQuadraticNodes))) return 0;
  return static_cast<std::size_t>(std::max(1.0, std::ceil(fewest)));
}

}  // namespace hiac
