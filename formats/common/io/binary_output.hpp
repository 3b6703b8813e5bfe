#pragma once

#include <cstring>
#include <fstream>
#include <string>
#include <string_view>

#include "hiac/base/output_file.hpp"

namespace hiac::formats {

/// A file that is written front to back, completely or not at all, from text and little-endian
/// numbers.
class BinaryOutput {
 public:
  /// Throws InputError naming the file when it cannot be created.
  explicit BinaryOutput(const std::string& path);

  void text(std::string_view words) {
    buffer_.append(words);
    if (buffer_.size() > kBufferBytes) flush();
  }
  template <typename Number>
  void number(Number value) {
    char bytes[sizeof(Number)];
    std::memcpy(bytes, &value, sizeof(Number));
    text({bytes, sizeof(Number)});
  }
  /// Renames the file to its destination. Throws InputError when a write failed.
  void finish();

 private:
  static constexpr std::size_t kBufferBytes = 1 << 20;
  void flush();

  std::string path_;
  OutputFile file_;
  std::ofstream stream_;
  std::string buffer_;
};

}  // namespace hiac::formats
