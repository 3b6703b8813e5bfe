#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Medit's (GMF) meshes, .mesh and .meshb.
Format medit_format();

}  // namespace hiac::formats
