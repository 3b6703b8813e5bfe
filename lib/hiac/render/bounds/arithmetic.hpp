#pragma once

#include "hiac/base/rounding.hpp"
#include "hiac/frame/screen_rounding.hpp"

namespace hiac {

/// The arithmetic that error bounds refer to: how the numbers of a pixel's computation are rounded.
struct Arithmetic {
  double unit;      ///< unit roundoff
  double snap;      ///< pixels by which corners may have been moved to pixels' centres
                    ///< (screen_rounding.hpp)
  double piece;     ///< relative error of a linear piece's weights, their evaluation and products
  double function;  ///< of values of transfer functions, relative to their summands
};

/// The engine's arithmetic, and that of recomputed pixels (pixel_refinement.hpp).
inline constexpr Arithmetic kDoubles{
    .unit = kUnit, .snap = kSnapToCenter, .piece = 2e-14, .function = 8 * kUnit};
// slopes of transfer functions are doubles
inline constexpr Arithmetic kExtended =
    kExtendedIsFiner
        ? Arithmetic{.unit = kExtendedUnit, .snap = 0, .piece = 5e-17, .function = 1.01 * kUnit}
        : kDoubles;

}  // namespace hiac
