#pragma once

#include <string>
#include <string_view>

#include <toml++/toml.h>

namespace hiac {

/// The largest text file that is read: specifications and colour-map presets are far smaller.
inline constexpr std::size_t kMaxTextBytes = std::size_t{64} << 20;

/// Returns the content of a text file. Throws InputError with the file's name if it cannot be read
/// or is larger than kMaxTextBytes.
std::string read_text_file(const std::string& path);

/// Parses TOML. Throws InputError "SUBJECT:LINE: ..." if it is malformed or its keys nest deeper
/// than those of any specification.
toml::table parse_toml(std::string_view text, const std::string& subject);

/// The text in one line: control characters become spaces.
std::string in_one_line(std::string text);

}  // namespace hiac
