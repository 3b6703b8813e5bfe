#pragma once

#include <limits>
#include <type_traits>

namespace hiac {

/// Unit roundoff u of double: one operation, rounded to nearest, gives the exact result times 1 + d
/// with |d| <= u. It is half of the distance from 1 to the next larger number.
inline constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;
static_assert(std::numeric_limits<double>::is_iec559 && kUnit == 0x1p-53,
              "all bounds of errors are derived for the binary64 format of IEEE 754");

/// Whether long double has mantissas of at least 64 bits, as on x87. If it is no longer than double
/// (or nearly so), computing with it says nothing about the rounding errors of doubles: pixels are
/// not recomputed (pixel_refinement.hpp), and bounds count its rounding as that of double.
inline constexpr bool kExtendedIsFiner = std::numeric_limits<long double>::digits >= 64;

/// Unit roundoff of long double, or a larger number: if mantissas are longer than 64 bits, that of
/// 64 bits, for which the counts of roundings and the truncation of series are chosen.
inline constexpr double kExtendedUnit = kExtendedIsFiner ? 0x1p-64 : kUnit;

/// The unit roundoff of either type.
template <class Real>
inline constexpr Real kUnitOf = std::is_same_v<Real, double> ? kUnit : kExtendedUnit;

}  // namespace hiac
