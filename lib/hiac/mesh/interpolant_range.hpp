#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// Bernstein coefficients of a kind's interpolant on the unit cube.
///
/// The cube's coordinates u, v, w are those of the reference cell, collapsed where it tapers:
///
///     tetrahedron   x = u (1-v) (1-w),  y = v (1-w),  z = w
///     pyramid       x = u (1-w),        y = v (1-w),  z = w
///     prism         x = u (1-v),        y = v,        z = w
///     wedge         x = u (2-v-w),      y = v,        z = w
///     brick         x = u,              y = v,        z = w
///
/// In these every kind's shape functions, the rational ones too, are polynomials of its order in
/// each of u, v and w. The interpolant lies between the smallest and the largest coefficient (R. T.
/// Farouki, "The Bernstein polynomial basis: a centennial retrospective", 2012, section 5).
/// Coefficient (i, j, k) in u, v, w is at (k (p+1) + j) (p+1) + i with p the order; those with
/// k = 0 are the interpolant's on the face z = 0.
struct InterpolantCoefficients {
  static constexpr std::size_t kMost = 64;
  std::array<double, kMost> c;
  std::size_t count = 0;  ///< (p+1)^3
  double rounding = 0;    ///< what each of them may be wrong by
};

/// Into `sums`, `count` of them and up to 7 more, what every node but the first has of them:
/// shares_of(k), for node k, points to what one unit of its value adds.
template <class SharesOf>
void add_shares(std::size_t nodes, std::size_t count, const SharesOf& shares_of,
                std::span<const double> values,
                std::array<double, InterpolantCoefficients::kMost>& sums) {
  // as many sums at a time as stay in registers
  constexpr std::size_t kTogether = 8;
  for (std::size_t first = 0; first < count; first += kTogether) {
    std::array<double, kTogether> sum{};
    for (std::size_t k = 1; k < nodes; ++k) {
      const double* share = shares_of(k) + first;
      for (std::size_t i = 0; i < kTogether; ++i) sum[i] += share[i] * values[k];
    }
    for (std::size_t i = 0; i < kTogether; ++i) sums[first + i] = sum[i];
  }
}

/// `values`: of the kind's nodes.
InterpolantCoefficients interpolant_coefficients(CellKind kind, std::span<const double> values);

/// Numbers between which an interpolant stays in the whole cell.
struct InterpolantRange {
  double least, most;
};

/// Bounds of the interpolant of `values` (of the kind's nodes): theirs for linear kinds, and for
/// others those of the coefficients, with their rounding: interpolants of higher order overshoot.
/// A constant's are itself.
InterpolantRange interpolant_range(CellKind kind, std::span<const double> values);

}  // namespace hiac
