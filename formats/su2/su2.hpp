#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// SU2 meshes (.su2).
Format su2_format();

}  // namespace hiac::formats
