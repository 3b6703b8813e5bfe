#pragma once

#include <string>
#include <vector>

namespace hiac::tools {

/// The one of the known words that is meant by a word that is not: the least one that begins with
/// it, or the one that the fewest letters put in, left out, changed or exchanged make of it, a
/// third of its letters at most; empty where there is none.
std::string likely_meant(const std::string& word, const std::vector<std::string>& known);

}  // namespace hiac::tools
