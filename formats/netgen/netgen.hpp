#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Netgen volume meshes (.vol, .vol.gz).
Format netgen_format();

}  // namespace hiac::formats
