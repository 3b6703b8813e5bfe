#include "formats/common/io/text_cursor.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <limits>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

/// Error messages show at most this many characters of a word.
constexpr std::size_t kShownBytes = 40;
/// No number in a file is longer; a longer word is not a number.
constexpr std::size_t kLongestNumber = 128;

bool is_exponent_letter(char c) { return c == 'd' || c == 'D' || c == 'q' || c == 'Q'; }

/// A number with a Fortran exponent: D for E, or a sign alone. Nothing when it is not a number.
std::optional<double> fortran_real(std::string_view word) {
  if (word.size() >= kLongestNumber) return std::nullopt;
  std::array<char, kLongestNumber + 1> copy{};
  std::size_t length = 0;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char c = word[i];
    const bool bare_sign =
        (c == '+' || c == '-') && i > 0 &&
        (std::isdigit(static_cast<unsigned char>(word[i - 1])) != 0 || word[i - 1] == '.');
    if (bare_sign) copy[length++] = 'e';
    copy[length++] = is_exponent_letter(c) ? 'e' : c;
    if (length >= kLongestNumber) return std::nullopt;
  }
  double value = 0;
  const char* end = copy.data() + length;
  const auto [stop, error] = std::from_chars(copy.data(), end, value);
  if (stop != end || error == std::errc::invalid_argument) return std::nullopt;
  return value;
}

/// The number at the beginning of [first, last) and where it ends, if the whole word is one.
std::optional<double> word_real(const char* first, const char* last) {
  const bool plus = first != last && *first == '+';
  if (plus) ++first;
  if (first == last || *first == '+' || (plus && *first == '-')) return std::nullopt;
  double value = 0;
  const auto [stop, error] = std::from_chars(first, last, value);
  if (stop == last && error == std::errc()) return value;
  // a number too small for a double is zero, one too large infinite: the gate and ranges report it
  if (stop == last && error == std::errc::result_out_of_range) {
    const std::string_view word(first, static_cast<std::size_t>(last - first));
    const bool small =
        word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
    const double magnitude = small ? 0.0 : std::numeric_limits<double>::infinity();
    return word.front() == '-' ? -magnitude : magnitude;
  }
  return fortran_real({first, static_cast<std::size_t>(last - first)});
}

}  // namespace

double TextCursor::real(std::string_view what) {
  skip_space();
  const char* stop = at_;
  // the usual case: from_chars finds the end of the word itself
  double value = 0;
  const auto [end, error] = std::from_chars(at_, end_, value);
  if (error == std::errc() && (end == end_ || is_space(*end))) {
    at_ = end;
    return value;
  }
  while (stop != end_ && !is_space(*stop)) ++stop;
  const std::optional<double> number = word_real(at_, stop);
  if (!number) refuse_word(what);
  at_ = stop;
  return *number;
}

std::size_t TextCursor::count(std::string_view what, std::size_t limit) {
  skip_space();
  const std::size_t start = offset();
  const std::int64_t value = integer(what);
  if (value < 0 || static_cast<std::uint64_t>(value) > limit)
    fail_at(start, fmt::format("{}: impossible (0 to {} expected, {} found)", what, limit, value));
  return static_cast<std::size_t>(value);
}

void TextCursor::fail_at(std::size_t offset, const std::string& what) const {
  const auto line = 1 + std::count(begin_, begin_ + offset, '\n');
  throw InputError(fmt::format("{}:{}", subject_, line), what);
}

void TextCursor::fail_in_data(std::size_t count, std::string_view what) const {
  throw InputError(subject_, fmt::format("at byte {}: the file ends within {} ({} bytes expected, "
                                         "{} found)",
                                         offset(), what, count, left()));
}

void TextCursor::refuse_word(std::string_view what) {
  skip_space();
  const std::size_t start = offset();
  const std::string_view found = word();
  if (found.empty()) fail_at(start, fmt::format("the file ends too early ({} expected)", what));
  fail_at(start, fmt::format("not understood ({} expected, {} found)", what, shown(found)));
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && TextCursor::is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && TextCursor::is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::string upper(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

bool starts_with_upper(std::string_view text, std::string_view prefix) {
  return text.size() >= prefix.size() &&
         std::equal(prefix.begin(), prefix.end(), text.begin(), [](char a, char b) {
           return a == static_cast<char>(std::toupper(static_cast<unsigned char>(b)));
         });
}

std::string shown(std::string_view word) {
  std::string result = "'";
  for (const char c : word.substr(0, kShownBytes))
    result += std::isprint(static_cast<unsigned char>(c)) != 0 ? c : '?';
  return result + (word.size() > kShownBytes ? "...'" : "'");
}

std::optional<std::int64_t> to_integer(std::string_view text) {
  text = without_plus(trimmed(text));
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> to_real(std::string_view text) {
  text = trimmed(text);
  return word_real(text.data(), text.data() + text.size());
}

}  // namespace hiac::formats
