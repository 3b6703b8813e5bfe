#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats {

/// The largest number of a node or element in decks whose keywords or commands generate them.
inline constexpr std::int64_t kLargestNumber = 999'999'999;

/// A deck may generate at most this many numbers, because a short deck can ask for any number.
inline constexpr std::size_t kMostMade = 16'000'000;

/// A whole number of such a deck, which may be written as a real (2.0), at most kLargestNumber in
/// absolute value; none when the text is not such a number.
inline std::optional<std::int64_t> whole_number(std::string_view text) {
  const auto real = to_real(text);
  if (!real || !(std::abs(*real) <= static_cast<double>(kLargestNumber)) ||
      std::trunc(*real) != *real)
    return std::nullopt;
  return static_cast<std::int64_t>(*real);
}

}  // namespace hiac::formats
