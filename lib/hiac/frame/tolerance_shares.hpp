#pragma once

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// The shares of the tolerance (Frame::tolerance) that a pixel's errors may take.
struct ToleranceShares {
  /// For the interpolation of fields that are not polynomials: it contributes at most four times to
  /// the bound in the channel "error".
  double field;
  double integration;
};

/// The share for the light behind the end of rays that are terminated early; because of it, a ray
/// is followed through 3.5 more units of optical depth.
inline constexpr double kEndShare = 0x1p-5;

/// The shares in cells of an order. In linear cells they are so small that at the default tolerance
/// of 1e-9 a pixel's bound stays below 1e-10. In cells of higher order, whose rounding has bounds
/// of that size, larger shares, together less than half of the tolerance, save more than a tenth of
/// the time.
constexpr ToleranceShares tolerance_shares(CellOrder order) {
  if (order == CellOrder::linear) return {0x1p-8, 0x1p-7};
  return {0x1p-4, 0x1p-3};
}

}  // namespace hiac
