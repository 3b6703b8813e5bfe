#pragma once

#include <string>
#include <vector>

namespace hiac::fuzz {

/// Small sound files of a format of surfaces, a tetrahedron's as a rule; none of other formats.
std::vector<std::string> surface_seeds(const std::string& format);

}  // namespace hiac::fuzz
