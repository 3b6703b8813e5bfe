#pragma once

#include <string>

namespace hiac::tools {

/// A message of the readers for the user of hiac-convert: the members of ReadOptions that it names
/// (formats/common/mesh/format.hpp) are called by the options that set them.
std::string with_option_names(std::string message);

}  // namespace hiac::tools
