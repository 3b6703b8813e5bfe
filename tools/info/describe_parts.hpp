#pragma once

#include <string>

#include "tools/info/describe.hpp"

namespace hiac::tools {

/// Whether a path names the index of a mesh in parts.
bool is_parted_mesh(const std::string& path);

/// Adds to the description of the whole what a mesh in parts is made of: the parts, how evenly
/// their cells and work are dealt out, and which of them are neighbours. Throws InputError.
void describe_parts(const std::string& index, Description& description);

}  // namespace hiac::tools
