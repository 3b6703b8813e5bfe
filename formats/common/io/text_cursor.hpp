#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hiac::formats {

/// A place in a text file that moves forward, word by word or line by line. Errors name the file
/// and the line, which is counted only when an error occurs.
class TextCursor {
 public:
  /// `text` must outlive the cursor; `subject` is the file's name.
  TextCursor(std::string_view text, std::string subject)
      : begin_(text.data()),
        at_(begin_),
        end_(begin_ + text.size()),
        subject_(std::move(subject)) {}

  [[nodiscard]] bool at_end() const { return at_ == end_; }
  /// The cursor's distance from the beginning and from the end, in bytes.
  [[nodiscard]] std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
  [[nodiscard]] std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
  void move_to(std::size_t offset) { at_ = begin_ + offset; }
  [[nodiscard]] std::string_view text() const {
    return {begin_, static_cast<std::size_t>(end_ - begin_)};
  }
  [[nodiscard]] const std::string& subject() const { return subject_; }

  /// The rest of the current line, without its end (\n, \r\n); the cursor moves past the end.
  std::string_view line() {
    const std::string_view rest(at_, left());
    const std::size_t length = rest.find('\n');
    at_ = length == std::string_view::npos ? end_ : at_ + length + 1;
    std::string_view result = rest.substr(0, length);
    if (result.ends_with('\r')) result.remove_suffix(1);
    return result;
  }
  /// The rest of the current line; the cursor stays.
  [[nodiscard]] std::string_view peek_line() const {
    TextCursor copy(*this, Bare{});
    return copy.line();
  }

  /// The next bytes, unchanged. Throws InputError when fewer are left.
  std::string_view bytes(std::size_t count, std::string_view what) {
    if (count > left()) fail_in_data(count, what);
    at_ += count;
    return {at_ - count, count};
  }

  /// Skips blanks and ends of lines.
  void skip_space() {
    while (at_ != end_ && is_space(*at_)) ++at_;
  }
  /// The next word, on this line or a later one; empty at the end of the file.
  std::string_view word() {
    skip_space();
    const char* start = at_;
    while (at_ != end_ && !is_space(*at_)) ++at_;
    return {start, static_cast<std::size_t>(at_ - start)};
  }
  /// The next word as a number, on this line or a later one. Throws InputError: "FILE:LINE: `what`
  /// expected ('x' found)". Reals may have a Fortran exponent (1.0D+5, 1.0+5).
  std::int64_t integer(std::string_view what) {
    skip_space();
    const char* at = at_;
    const bool negative = at != end_ && *at == '-';
    if (at != end_ && (*at == '-' || *at == '+')) ++at;
    std::uint64_t value = 0;
    const char* digits = at;
    while (at != end_ && *at >= '0' && *at <= '9' && at - digits < kSafeDigits)
      value = 10 * value + static_cast<std::uint64_t>(*at++ - '0');
    if (at == digits || (at != end_ && !is_space(*at))) refuse_word(what);
    at_ = at;
    return negative ? -static_cast<std::int64_t>(value) : static_cast<std::int64_t>(value);
  }
  double real(std::string_view what);
  /// A count: not negative, and no more than `limit` (what the rest of the file can hold).
  std::size_t count(std::string_view what, std::size_t limit);

  /// Throws InputError "FILE:LINE: `what`", for the cursor's line or for the line of the given
  /// place.
  [[noreturn]] void fail(const std::string& what) const { fail_at(offset(), what); }
  [[noreturn]] void fail_at(std::size_t offset, const std::string& what) const;
  /// Throws InputError "FILE: at byte N: ...": binary data end too early.
  [[noreturn]] void fail_in_data(std::size_t count, std::string_view what) const;
  /// Throws InputError "... `what` expected (the next word found)".
  [[noreturn]] void refuse_word(std::string_view what);

  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

 private:
  /// Number of digits that always fit in 64 bits.
  static constexpr std::ptrdiff_t kSafeDigits = 18;
  struct Bare {};
  /// A copy without a name, for looking ahead.
  TextCursor(const TextCursor& other, Bare /*tag*/)
      : begin_(other.begin_), at_(other.at_), end_(other.end_) {}

  const char* begin_;
  const char* at_;
  const char* end_;
  std::string subject_;
};

/// The text without blanks, tabs and carriage returns at either end.
std::string_view trimmed(std::string_view text);
/// The text in capitals (ASCII).
std::string upper(std::string_view text);
/// Whether `text` begins with `prefix`, ignoring case; `prefix` is given in capitals.
bool starts_with_upper(std::string_view text, std::string_view prefix);
/// A word for an error message: printable, shortened.
std::string shown(std::string_view word);

/// A number's word without a plus sign before it; unchanged where a minus sign follows the plus.
inline std::string_view without_plus(std::string_view word) {
  return word.starts_with('+') && !word.starts_with("+-") ? word.substr(1) : word;
}

/// The whole of `text` as a number, blanks at either end apart; reals as in TextCursor::real.
std::optional<std::int64_t> to_integer(std::string_view text);
std::optional<double> to_real(std::string_view text);

}  // namespace hiac::formats
