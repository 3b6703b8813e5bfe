#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// Bernstein coefficients of a kind's interpolant on the unit cube.
///
/// The cube's coordinates u, v, w determine the reference cell's, collapsed where the cell tapers:
///
///     tetrahedron   x = u (1-v) (1-w),  y = v (1-w),  z = w
///     pyramid       x = u (1-w),        y = v (1-w),  z = w
///     prism         x = u (1-v),        y = v,        z = w
///     wedge         x = u (2-v-w),      y = v,        z = w
///     brick         x = u,              y = v,        z = w
///
/// In u, v and w the shape functions of every kind, also the rational ones, are polynomials whose
/// degree in each is the kind's order. The interpolant lies between the extreme coefficients (R. T.
/// Farouki, "The Bernstein polynomial basis: a centennial retrospective", 2012, section 5).
/// Coefficient (i, j, k) in u, v, w has index (k (p+1) + j) (p+1) + i, where p is the order; the
/// coefficients with k = 0 belong to the interpolant on the face z = 0.
struct InterpolantCoefficients {
  static constexpr std::size_t kMost = 64;
  std::array<double, kMost> c;
  std::size_t count = 0;  ///< (p+1)^3
  double rounding = 0;    ///< error bound of each coefficient
};

/// Adds to `sums` (`count` sums, padded by up to 7) the contributions of all nodes but the first:
/// shares_of(k) points to the contribution of a unit value at node k.
template <class SharesOf>
void add_shares(std::size_t nodes, std::size_t count, const SharesOf& shares_of,
                std::span<const double> values,
                std::array<double, InterpolantCoefficients::kMost>& sums) {
  // as many sums at a time as fit into registers
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

/// Returns the coefficients; `values` are those at the kind's nodes.
InterpolantCoefficients interpolant_coefficients(CellKind kind, std::span<const double> values);

/// Bounds of a field in a cell, or in part of it.
struct ValueRange {
  double least, most;
};

/// Bounds of the interpolant of `values` (at the kind's nodes): the extreme values for linear
/// kinds; for the others, whose interpolants overshoot, the extreme coefficients widened by their
/// rounding. Both bounds of a constant are the constant.
ValueRange interpolant_range(CellKind kind, std::span<const double> values);

}  // namespace hiac
