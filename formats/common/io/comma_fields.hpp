#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats {

/// The fields of one line, separated by commas, as in decks of solvers; blanks around a field are
/// ignored.
class CommaFields {
 public:
  explicit CommaFields(std::string_view line) : at_(line.data()), end_(at_ + line.size()) {}

  /// Whether the line has no further field; a comma at its end starts no field.
  [[nodiscard]] bool at_end() {
    skip_blanks();
    return at_ == end_;
  }
  /// The next field as an integer; none when it is empty or not an integer.
  std::optional<std::int64_t> integer() {
    skip_blanks();
    const char* at = at_;
    const bool negative = at != end_ && *at == '-';
    if (at != end_ && (*at == '-' || *at == '+')) ++at;
    const char* const digits = at;
    std::int64_t value = 0;
    while (at != end_ && *at >= '0' && *at <= '9' && at - digits < kSafeDigits)
      value = 10 * value + (*at++ - '0');
    if (at == digits || !ends_at(at)) return to_integer(field());
    step_over(at);
    return negative ? -value : value;
  }
  /// The next field as a real; none when it is not a real, 0 when it is empty.
  std::optional<double> real() {
    skip_blanks();
    double value = 0;
    const auto [stop, error] = std::from_chars(at_, end_, value);
    if (error != std::errc() || !ends_at(stop)) {
      const std::string_view text = trimmed(field());
      return text.empty() ? std::optional<double>(0.0) : to_real(text);
    }
    step_over(stop);
    return value;
  }
  /// The next field as it is, without blanks at its ends.
  std::string_view field() {
    const char* start = at_;
    while (at_ != end_ && *at_ != ',') ++at_;
    const std::string_view text(start, static_cast<std::size_t>(at_ - start));
    if (at_ != end_) ++at_;
    return trimmed(text);
  }

 private:
  static constexpr std::ptrdiff_t kSafeDigits = 18;
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  void skip_blanks() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
  }
  [[nodiscard]] bool ends_at(const char* at) const {
    while (at != end_ && is_blank(*at)) ++at;
    return at == end_ || *at == ',';
  }
  void step_over(const char* at) {
    at_ = at;
    skip_blanks();
    if (at_ != end_) ++at_;
  }

  const char* at_;
  const char* end_;
};

}  // namespace hiac::formats
