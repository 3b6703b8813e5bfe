#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hiac/scene/toml/spec_path.hpp"

namespace hiac {

/// Where keys, values and tables stand in a text that is valid TOML, in bytes. What it means is for
/// the parser to say (parse_toml).

/// The bytes from `begin` to before `end`.
struct TextSpan {
  std::size_t begin;
  std::size_t end;

  [[nodiscard]] std::string_view of(std::string_view text) const {
    return text.substr(begin, end - begin);
  }
};

/// A line (or several) `key = value` with the comment behind it.
struct KeyLine {
  SpecPath key;      ///< below its section; several parts where the key is dotted
  TextSpan written;  ///< the key as written
  TextSpan value;
  TextSpan lines;  ///< whole lines, their ends included
};

/// A header `[table]` or `[[table]]` and the lines up to the next one. The first section is the
/// text before any header.
struct TextSection {
  SpecPath path;  ///< elements of lists of tables by their numbers
  bool is_element = false;
  TextSpan header;  ///< whole lines; empty for the first section
  std::vector<KeyLine> keys;
};

std::vector<TextSection> sections_of(std::string_view text);

/// An element of a list, or a key and its value in a table in braces.
struct TextElement {
  SpecPath key;   ///< empty in a list
  TextSpan span;  ///< key and value
  TextSpan value;
};

/// The elements of the value that starts at `begin`; none if it is no list and no table in braces.
std::vector<TextElement> elements_of(std::string_view text, std::size_t begin);

/// Returns the position behind blanks, ends of lines and comments.
std::size_t skip_space(std::string_view text, std::size_t at);

/// Returns the position behind the string that starts at `at`, or the end of the text.
std::size_t skip_string(std::string_view text, std::size_t at);

}  // namespace hiac
