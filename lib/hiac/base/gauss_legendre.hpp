#pragma once

#include <cstddef>
#include <span>

namespace hiac {

/// The largest number of nodes that gauss_legendre provides.
inline constexpr std::size_t kMaxGaussNodes = 24;

/// Nodes in (-1, 1), increasing, and positive weights that sum to 2, each correct to an ulp.
template <class Real>
struct BasicGaussRule {
  std::span<const Real> nodes;
  std::span<const Real> weights;
};
using GaussRule = BasicGaussRule<double>;

/// Returns the Gauss-Legendre rule with 1 <= n <= kMaxGaussNodes nodes; it lives as long as the
/// process.
GaussRule gauss_legendre(std::size_t n);
/// Returns the same in extended precision, correct to about 2^-60.
BasicGaussRule<long double> extended_gauss_legendre(std::size_t n);

}  // namespace hiac
