#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "formats/common/io/mapped_file.hpp"
#include "hiac/base/shared_array.hpp"

namespace hiac::formats {

/// The bytes of a file, mapped into memory; a gzip file is unpacked. A byte-order mark before UTF-8
/// is skipped.
class InputText {
 public:
  /// Throws InputError naming the file when it cannot be opened, is not a regular file, or is a
  /// damaged gzip file.
  explicit InputText(const std::string& path);

  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::unique_ptr<MappedFile> file_;  ///< none once unpacked
  SharedArray<std::uint8_t> unpacked_;
  std::string_view text_;
};

/// The text without the mark that some editors put before UTF-8.
std::string_view without_byte_order_mark(std::string_view text);

/// Whether these are the first bytes of a gzip file.
bool is_gzip(std::string_view head);

/// Unpacks the beginning of a gzip file, at most `limit` bytes; fewer when the data end early or
/// are damaged.
std::string unpacked_head(std::string_view head, std::size_t limit);

}  // namespace hiac::formats
