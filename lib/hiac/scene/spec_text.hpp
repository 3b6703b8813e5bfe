#pragma once

#include <string>
#include <string_view>

#include <toml++/toml.h>

namespace hiac {

/// Largest text file that is read whole: specifications and colour-map presets are far smaller.
inline constexpr std::size_t kMaxTextBytes = std::size_t{64} << 20;

/// A text file's content. Throws InputError naming the file when it cannot be read or is larger
/// than kMaxTextBytes.
std::string read_text_file(const std::string& path);

/// Parses TOML. Throws InputError "SUBJECT:LINE: ..." where it is malformed or keys nest deeper
/// than any specification does.
toml::table parse_toml(std::string_view text, const std::string& subject);

/// The text in one line: control characters become spaces.
std::string in_one_line(std::string text);

}  // namespace hiac
