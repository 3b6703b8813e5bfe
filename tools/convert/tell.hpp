#pragma once

#include <string>

#include "tools/common/tool.hpp"

namespace hiac::tools {

/// Prints a note and adds it to the facts.
inline void tell(Tool& tool, const std::string& note) {
  tool.note(note);
  tool.facts()["notes"].push_back(note);
}

}  // namespace hiac::tools
