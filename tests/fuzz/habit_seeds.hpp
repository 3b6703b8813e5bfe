#pragma once

#include <string>
#include <vector>

namespace hiac::fuzz {

/// Small sound files of a format with what its writers and users are free to do: hanging nodes and
/// ranks, nodes that are left out, cells that are collapsed, values and sets of what is not there.
std::vector<std::string> habit_seeds(const std::string& format);

}  // namespace hiac::fuzz
