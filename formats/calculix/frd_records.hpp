#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats::frd {

/// The four encodings of an .frd block (CalculiX GraphiX manual, "Result Format"): numbers of nodes
/// in 5 or in 10 columns, or binary with 4- or with 8-byte reals (little-endian).
enum class Encoding : std::uint8_t { short_text = 0, long_text = 1, binary_float, binary_double };

constexpr bool is_text(Encoding encoding) { return encoding <= Encoding::long_text; }

/// Reads the records of one block: a number and its values, over continuation lines in text.
class Records {
 public:
  Records(TextCursor& cursor, Encoding encoding) : cursor_(cursor), encoding_(encoding) {}

  /// Whether a text block has another record; if not, moves past the block's last line (" -3"). The
  /// head of a binary block states how many records there are.
  bool next_text_record();
  /// The number and the `width` values of the record. Values that are not numbers (a solver's
  /// failed step) are NaN.
  std::int64_t read(std::size_t width, double* values);
  /// The size of a binary record in bytes.
  [[nodiscard]] std::size_t binary_bytes(std::size_t width) const {
    return 4 + width * (encoding_ == Encoding::binary_float ? 4U : 8U);
  }

 private:
  std::int64_t read_text(std::size_t width, double* values);
  std::int64_t read_binary(std::size_t width, double* values);

  TextCursor& cursor_;
  Encoding encoding_;
};

/// Throws InputError saying that so many records are more than the file can hold, unless they fit.
void require_records(const TextCursor& cursor, bool fit, std::size_t records);

/// Columns [first, first + width) of a line, as far as the line reaches.
inline std::string_view columns(std::string_view line, std::size_t first, std::size_t width) {
  return first < line.size() ? line.substr(first, width) : std::string_view();
}

}  // namespace hiac::formats::frd
