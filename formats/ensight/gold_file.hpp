#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "formats/common/io/input_text.hpp"
#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats::ensight {

/// How a file's numbers are stored.
struct Encoding {
  bool binary = false;
  bool swap = false;    ///< the other byte order than this machine's
  bool marked = false;  ///< Fortran's marks round every record of a binary file
};

/// A geometry or variable file, in ASCII, C binary or Fortran binary: texts (80 bytes in binary, a
/// line in ASCII), whole numbers and reals. Throws InputError with the line or the byte.
class GoldFile {
 public:
  /// The geometry says "C Binary" or "Fortran Binary"; variable files do not say it, and have the
  /// same encoding.
  static GoldFile open_geometry(const std::string& path);
  GoldFile(const std::string& path, const Encoding& encoding);

  [[nodiscard]] const Encoding& encoding() const { return encoding_; }
  /// Moves to the beginning of that step if the file holds several ("BEGIN TIME STEP").
  void select_step(std::size_t step);
  /// Whether the file or the step ends here.
  [[nodiscard]] bool at_end();
  /// The next text without blanks at its ends; with `peek`, the text is not consumed.
  std::string text(bool peek = false);
  std::int64_t whole();
  /// A count of items that take at least that many bytes each.
  std::size_t count(std::size_t bytes_each = 4);
  /// A part number: the first number of a binary geometry, which determines its byte order.
  std::int64_t part_number();
  std::vector<std::int64_t> wholes(std::size_t amount);
  std::vector<double> reals(std::size_t amount);

  /// Names the line of what was read last: of a text or, in a list of numbers, of the number at
  /// that place. For binary files, names the byte behind it.
  [[noreturn]] void fail(const std::string& problem, std::size_t place = 0) const;

 private:
  std::uint32_t word();

  std::shared_ptr<InputText> input_;
  std::shared_ptr<const std::string> unmarked_;  ///< the bytes of a marked file without its marks
  TextCursor cursor_;
  std::size_t last_ = 0;  ///< where the last text or list begins
  Encoding encoding_;
  bool order_known_ = false;
};

}  // namespace hiac::formats::ensight
