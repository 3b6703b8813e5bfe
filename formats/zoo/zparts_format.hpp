#pragma once

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// The project's parted mesh (lib/hiac/mesh/parted/parted-mesh.md), read as the whole that its
/// parts make; written as one part. Parts outside the index's folder are files that it names
/// (named_file.hpp).
Format zparts_format();

}  // namespace hiac::formats
