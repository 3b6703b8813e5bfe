#pragma once

#include <array>

#include "hiac/geometry/bezier_patch.hpp"

namespace hiac::test {

/// Every shape that a face's patch may have.
inline constexpr std::array<PatchShape, 7> kPatchShapes{{{1, false, false},
                                                         {2, false, false},
                                                         {3, false, false},
                                                         {1, true, false},
                                                         {2, true, false},
                                                         {3, true, false},
                                                         {3, true, true}}};

}  // namespace hiac::test
