#pragma once

#include <cstddef>
#include <span>

namespace hiac {

/// Largest number of nodes that gauss_legendre offers.
inline constexpr std::size_t kMaxGaussNodes = 24;

/// Nodes in (-1, 1), increasing, and positive weights that sum to 2, each correct to an ulp.
struct GaussRule {
  std::span<const double> nodes;
  std::span<const double> weights;
};

/// The Gauss-Legendre rule with 1 <= n <= kMaxGaussNodes nodes; it lives as long as the process.
GaussRule gauss_legendre(std::size_t n);

}  // namespace hiac
