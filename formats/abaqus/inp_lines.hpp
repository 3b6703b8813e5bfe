#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/common/io/comma_fields.hpp"
#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats::abaqus {

/// A line `*KEYWORD, NAME=VALUE, ...` with the lines that continue it.
struct Keyword {
  std::string name;                                             ///< in capitals, without the star
  std::vector<std::pair<std::string, std::string>> parameters;  ///< names in capitals
  std::size_t offset = 0;

  /// The value of a parameter, whose name is given in capitals and without blanks; empty when it
  /// has no value. Null when the parameter is absent.
  [[nodiscard]] const std::string* value(std::string_view parameter) const;
  [[nodiscard]] bool has(std::string_view parameter) const { return value(parameter) != nullptr; }
  /// Whether a parameter without a value is present, in full or abbreviated to three letters or
  /// more.
  [[nodiscard]] bool has_flag(std::string_view parameter) const;
};

/// Blanks before stars are ignored.
bool is_comment(std::string_view line);
bool is_keyword(std::string_view line);

/// Reads the keyword that the next line begins.
Keyword read_keyword(TextCursor& cursor);

/// The value of a required parameter. Throws InputError naming the keyword's line.
std::string required(const Keyword& keyword, std::string_view parameter, const TextCursor& cursor);

/// The next data line that is not blank; none where the next keyword begins or the file ends.
std::optional<std::string_view> data_line(TextCursor& cursor);
/// The same, but blank lines are data lines: their fields are zero.
std::optional<std::string_view> data_line_or_blank(TextCursor& cursor);

/// Throws an InputError saying that `what` was expected in `line`, which lies in the cursor's text.
[[noreturn]] void refuse(const TextCursor& cursor, std::string_view line, std::string_view what);

/// The next field; an empty real is 0.
double real_in(CommaFields& fields, const TextCursor& cursor, std::string_view line);
std::int64_t integer_in(CommaFields& fields, const TextCursor& cursor, std::string_view line,
                        std::string_view what);

}  // namespace hiac::formats::abaqus
