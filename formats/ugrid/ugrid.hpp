#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// UGRID (AFLR3) meshes: text and all binary variants (b8, lb8, b4, lb4, r8, lr8, r4, lr4).
Format ugrid_format();

}  // namespace hiac::formats
