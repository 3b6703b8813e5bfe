#include "formats/calculix/frd_records.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>

#include <fmt/format.h>

namespace hiac::formats::frd {
namespace {

constexpr std::size_t kValueColumns = 12;
constexpr std::size_t kValuesInLine = 6;

template <typename Number>
Number number_at(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof(Number));
  return number;
}

/// A value in its columns; no blank need separate it from the next value.
double value_in(std::string_view text, const TextCursor& cursor, std::size_t line_start) {
  double value = 0;
  const std::string_view word = trimmed(text);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc() && end == word.data() + word.size() && !word.empty()) return value;
  if (const auto number = to_real(word)) return *number;
  // Fortran and C write words or stars for values that do not fit the columns or are not numbers
  if (word.find_first_of("NnIi*") != std::string_view::npos)
    return std::numeric_limits<double>::quiet_NaN();
  cursor.fail_at(line_start, fmt::format("a value of {} columns expected ({} found)", kValueColumns,
                                         shown(text)));
}

/// Values of a line that is longer than its columns: three-digit exponents push the following
/// values to the right. A value ends after the digits of its exponent.
void values_in_long_line(std::string_view text, std::size_t count, double* values,
                         const TextCursor& cursor, std::size_t line_start) {
  for (std::size_t i = 0; i < count; ++i) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    std::size_t end = text.find_first_of("Ee ");
    if (end != std::string_view::npos && text[end] != ' ')
      end = text.find_first_not_of("0123456789", std::min(end + 2, text.size()));
    end = std::min(end, text.size());
    values[i] = value_in(text.substr(0, end), cursor, line_start);
    text.remove_prefix(end);
  }
}

}  // namespace

bool Records::next_text_record() {
  while (true) {
    if (cursor_.at_end()) cursor_.fail("the file ends too early (' -3' expected)");
    const std::string_view line = cursor_.peek_line();
    const std::string_view mark = trimmed(columns(line, 0, 3));
    if (mark == "-1") return true;
    if (mark == "-3") {
      cursor_.line();
      return false;
    }
    if (mark.empty() && trimmed(line).empty()) {
      cursor_.line();
      continue;
    }
    cursor_.fail(fmt::format("a record ' -1' or ' -3' expected ({} found)", shown(line)));
  }
}

std::int64_t Records::read(std::size_t width, double* values) {
  return is_text(encoding_) ? read_text(width, values) : read_binary(width, values);
}

std::int64_t Records::read_text(std::size_t width, double* values) {
  const std::size_t number_columns = encoding_ == Encoding::short_text ? 5 : 10;
  std::size_t start = cursor_.offset();
  std::string_view line = cursor_.line();
  const auto number = to_integer(columns(line, 3, number_columns));
  if (!number)
    cursor_.fail_at(
        start, fmt::format("a number in columns 4 to {} expected ({} found)", 3 + number_columns,
                           shown(columns(line, 3, number_columns))));
  const std::size_t first = 3 + number_columns;
  for (std::size_t i = 0; i < width; ++i) {
    const std::size_t in_line = i % kValuesInLine;
    if (i > 0 && in_line == 0) {
      start = cursor_.offset();
      line = cursor_.line();
      if (trimmed(columns(line, 0, 3)) != "-2")
        cursor_.fail_at(start,
                        fmt::format("a continuation ' -2' expected ({} found)", shown(line)));
    }
    if (const std::size_t count = std::min(kValuesInLine, width - i);
        in_line == 0 && columns(line, first, line.size()).size() > count * kValueColumns &&
        !trimmed(columns(line, first + count * kValueColumns, line.size())).empty()) {
      values_in_long_line(line.substr(first), count, values + i, cursor_, start);
      i += count - 1;
      continue;
    }
    values[i] =
        value_in(columns(line, first + in_line * kValueColumns, kValueColumns), cursor_, start);
  }
  return *number;
}

std::int64_t Records::read_binary(std::size_t width, double* values) {
  const char* bytes = cursor_.bytes(binary_bytes(width), "a record").data();
  const auto number = number_at<std::int32_t>(bytes);
  bytes += sizeof(std::int32_t);
  for (std::size_t i = 0; i < width; ++i)
    values[i] = encoding_ == Encoding::binary_float
                    ? static_cast<double>(number_at<float>(bytes + sizeof(float) * i))
                    : number_at<double>(bytes + sizeof(double) * i);
  return number;
}

void require_records(const TextCursor& cursor, bool fit, std::size_t records) {
  if (!fit) cursor.fail(fmt::format("{} records announced, more than the file can hold", records));
}

}  // namespace hiac::formats::frd
