#pragma once

#include <cstddef>
#include <string>

namespace hiac::formats {

/// Enough for every format's first words, an XML declaration and comments included.
inline constexpr std::size_t kHeadBytes = 4096;

/// The first kHeadBytes of a file, or all of it. Throws InputError when it cannot be read.
std::string file_head(const std::string& path);

/// The path of a file that the file `path` names, relative to where that is. Throws
/// InputError(path, ...) when the name holds characters that no message of one line can show.
std::string file_beside(const std::string& path, const std::string& named);

}  // namespace hiac::formats
