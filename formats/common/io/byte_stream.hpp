#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace hiac::formats {

/// Numbers of a binary file of either byte order, one after the other.
class ByteStream {
 public:
  ByteStream(std::string_view bytes, std::string subject)
      : bytes_(bytes), subject_(std::move(subject)) {}

  void set_order(std::endian order) { swapped_ = order != std::endian::native; }
  [[nodiscard]] std::size_t offset() const { return at_; }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
  /// Moves to that offset, which is at most the size.
  void move_to(std::size_t offset) { at_ = offset; }

  /// The next number. Throws InputError "FILE: at byte N: ..." when the file ends.
  template <typename Number>
  Number read(std::string_view what) {
    if (left() < sizeof(Number)) fail_at_end(what);
    char raw[sizeof(Number)];
    std::memcpy(raw, bytes_.data() + at_, sizeof(Number));
    if (swapped_) std::reverse(std::begin(raw), std::end(raw));
    at_ += sizeof(Number);
    Number number;
    std::memcpy(&number, raw, sizeof(Number));
    return number;
  }
  /// Skips bytes. Throws as read does.
  void skip(std::size_t count, std::string_view what) {
    if (left() < count) fail_at_end(what);
    at_ += count;
  }
  [[noreturn]] void fail(const std::string& what) const;

 private:
  [[noreturn]] void fail_at_end(std::string_view what) const;

  std::string_view bytes_;
  std::string subject_;
  std::size_t at_ = 0;
  bool swapped_ = false;
};

}  // namespace hiac::formats
