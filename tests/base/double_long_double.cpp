// Compiled with a long double that is double, and never linked: what is claimed of rounding there.
#include "hiac/base/rounding.hpp"
#include "hiac/render/bounds/arithmetic.hpp"

namespace hiac {

static_assert(sizeof(long double) == sizeof(double));
static_assert(!kExtendedIsFiner);
static_assert(kExtendedUnit == 0x1p-53 && kUnitOf<long double> == 0x1p-53);
static_assert(kExtended.unit == kDoubles.unit && kExtended.piece == kDoubles.piece &&
              kExtended.function == kDoubles.function && kExtended.snap == kDoubles.snap);

}  // namespace hiac
