#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats {

/// The whole of a word as a number, which may have one sign; nan and inf are numbers, too.
inline std::optional<double> plain_number(std::string_view word) {
  word = without_plus(word);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace hiac::formats
