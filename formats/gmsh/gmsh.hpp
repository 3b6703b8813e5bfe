#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Gmsh's MSH files, versions 1, 2 to 2.2, 4.0 and 4.1, text and binary; written as 4.1.
Format gmsh_format();

}  // namespace hiac::formats
