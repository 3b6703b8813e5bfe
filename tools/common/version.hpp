#pragma once

#include <string>

namespace hiac::tools {

/// The version of hiac and, in brackets, those of the libraries that this build stands on: one
/// line.
std::string version_text();

}  // namespace hiac::tools
