#pragma once

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// What of the tolerance (Frame::tolerance) errors of a pixel may take.
struct ToleranceShares {
  /// For what becomes of fields that are not polynomials: of the bound that the channel "error"
  /// claims it counts four times at most.
  double field;
  double integration;
};

/// For what is not seen behind where rays are ended early; a ray is followed through 3.5 more of
/// optical depth.
inline constexpr double kEndShare = 0x1p-5;

/// In cells of an order. In linear ones all are so small that at the default tolerance of 1e-9 they
/// together leave a pixel's bound below 1e-10. In cells of higher order, whose rounding has bounds
/// of that size, less than half of the tolerance saves more than a tenth of the time.
constexpr ToleranceShares tolerance_shares(CellOrder order) {
  if (order == CellOrder::linear) return {0x1p-8, 0x1p-7};
  return {0x1p-4, 0x1p-3};
}

}  // namespace hiac
