#pragma once

#include <string>
#include <vector>

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Adds the formats of structured meshes and of binary results: those that are read through a
/// library of their own, if this build has it, and those that need no library.
void add_library_formats(std::vector<Format>& formats);

/// The versions of those libraries, each with a comma before it: ", HDF5 1.10.8".
std::string further_library_versions();

}  // namespace hiac::formats
