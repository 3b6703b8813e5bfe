#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// TetGen meshes: .node and .ele in one folder; the path names either.
Format tetgen_format();

}  // namespace hiac::formats
