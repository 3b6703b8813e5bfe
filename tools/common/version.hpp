#pragma once

#include <string>

namespace hiac::tools {

/// The version of hiac and, in brackets, the versions of the libraries of this build: one line.
std::string version_text();

}  // namespace hiac::tools
