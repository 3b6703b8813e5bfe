#pragma once

#include "formats/format.hpp"

namespace hiac::formats {

/// Medit's (GMF) meshes, .mesh and .meshb.
Format medit_format();

}  // namespace hiac::formats
