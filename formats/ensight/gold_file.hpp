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
  /// The geometry says "C Binary" or "Fortran Binary"; variable files do not, and are encoded as
  /// the geometry is.
  static GoldFile open_geometry(const std::string& path);
  GoldFile(const std::string& path, const Encoding& encoding);

  [[nodiscard]] const Encoding& encoding() const { return encoding_; }
  /// Moves to the beginning of that step where the file holds several ("BEGIN TIME STEP").
  void select_step(std::size_t step);
  /// At the end of the file or of the step.
  [[nodiscard]] bool at_end();
  /// The next text without blanks at its ends; stays in front of it where `peek`.
  std::string text(bool peek = false);
  std::int64_t whole();
  /// A count of things of at least that many bytes each.
  std::size_t count(std::size_t bytes_each = 4);
  /// One number of parts: tells the byte order of a binary geometry, of which it is the first.
  std::int64_t part_number();
  std::vector<std::int64_t> wholes(std::size_t amount);
  std::vector<double> reals(std::size_t amount);

  [[noreturn]] void fail(const std::string& problem) const;

 private:
  std::uint32_t word();

  std::shared_ptr<InputText> input_;
  std::shared_ptr<const std::string> unmarked_;  ///< the bytes of a marked file without its marks
  TextCursor cursor_;
  Encoding encoding_;
  bool order_known_ = false;
};

}  // namespace hiac::formats::ensight
