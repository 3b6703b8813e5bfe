#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// TetGen meshes: .node and .ele beside each other; either is named.
Format tetgen_format();

}  // namespace hiac::formats
