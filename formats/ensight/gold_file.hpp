#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "formats/input_text.hpp"
#include "formats/text_cursor.hpp"

namespace hiac::formats::ensight {

/// A geometry or variable file, in ASCII or C binary: texts (80 bytes in binary, a line in ASCII),
/// whole numbers and reals. Throws InputError with the line or the byte.
class GoldFile {
 public:
  /// `geometry`: whether the file may say "C Binary"; variable files do not, and are of the sort
  /// and byte order that the geometry is.
  static GoldFile open_geometry(const std::string& path);
  GoldFile(const std::string& path, bool binary, bool swap);

  [[nodiscard]] bool binary() const { return binary_; }
  [[nodiscard]] bool swapped() const { return swap_; }
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
  TextCursor cursor_;
  bool binary_;
  bool swap_;
  bool order_known_ = false;
};

}  // namespace hiac::formats::ensight
