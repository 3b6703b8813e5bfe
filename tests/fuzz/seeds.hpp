#pragma once

#include <string>
#include <vector>

namespace hiac::fuzz {

/// Small sound inputs of the target of that name (target.hpp), to begin from.
std::vector<std::string> seeds(const std::string& name);

}  // namespace hiac::fuzz
