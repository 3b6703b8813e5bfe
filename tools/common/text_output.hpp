#pragma once

#include <string>

namespace hiac::tools {

/// Writes a text to a file, or to stdout where `path` is "-" or empty. Throws InputError when it
/// cannot be written.
void write_text(const std::string& path, const std::string& text);

}  // namespace hiac::tools
