#pragma once

#include "hiac/base/rounding.hpp"
#include "hiac/frame/screen_rounding.hpp"

namespace hiac {

/// What bounds of errors count in: how the numbers are rounded that a pixel is made with.
struct Arithmetic {
  double unit;      ///< unit roundoff
  double snap;      ///< pixels by which corners may have been moved to pixels' centres
                    ///< (screen_rounding.hpp)
  double piece;     ///< relative error of a linear piece's weights, their evaluation and products
  double function;  ///< of values of transfer functions, relative to what they are the sums of
};

/// The engine's own, and that of pixels computed again (pixel_refinement.hpp).
inline constexpr Arithmetic kDoubles{
    .unit = kUnit, .snap = kSnapToCenter, .piece = 2e-14, .function = 8 * kUnit};
// slopes of transfer functions are doubles
inline constexpr Arithmetic kExtended =
    kExtendedIsFiner
        ? Arithmetic{.unit = kExtendedUnit, .snap = 0, .piece = 5e-17, .function = 1.01 * kUnit}
        : kDoubles;

}  // namespace hiac
