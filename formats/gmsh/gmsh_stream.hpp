#pragma once

#include <cstring>
#include <string_view>
#include <utility>

#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats::gmsh {

/// The numbers of an MSH file, as words or binary: 32-bit integers, 64-bit sizes, doubles.
class MshStream {
 public:
  explicit MshStream(TextCursor cursor) : cursor_(std::move(cursor)) {}

  TextCursor& cursor() { return cursor_; }
  [[nodiscard]] const TextCursor& cursor() const { return cursor_; }
  void set_binary(bool swapped) {
    binary_ = true;
    swapped_ = swapped;
  }
  [[nodiscard]] bool binary() const { return binary_; }
  /// An integer that binary files of versions 4 store in 64 bits.
  std::int64_t wide(std::string_view what) {
    return binary_ ? raw<std::int64_t>(what) : cursor_.integer(what);
  }
  std::int64_t integer(std::string_view what) {
    return binary_ ? raw<std::int32_t>(what) : cursor_.integer(what);
  }
  double real(std::string_view what) { return binary_ ? raw<double>(what) : cursor_.real(what); }

  /// A count of items that each take at least `bytes` binary bytes (as text at least two); refused
  /// when the rest of the file cannot hold that many.
  std::size_t count(std::string_view what, std::size_t bytes) {
    return checked(wide(what), what, bytes);
  }
  std::size_t narrow_count(std::string_view what, std::size_t bytes) {
    return checked(integer(what), what, bytes);
  }
  void skip(std::size_t bytes, std::string_view what) { cursor_.bytes(bytes, what); }

  [[noreturn]] void fail(const std::string& what) const;

 private:
  template <typename Number>
  Number raw(std::string_view what) {
    char bytes[sizeof(Number)];
    std::memcpy(bytes, cursor_.bytes(sizeof(Number), what).data(), sizeof(Number));
    if (swapped_)
      for (std::size_t i = 0; i < sizeof(Number) / 2; ++i)
        std::swap(bytes[i], bytes[sizeof(Number) - 1 - i]);
    Number number;
    std::memcpy(&number, bytes, sizeof(Number));
    return number;
  }
  std::size_t checked(std::int64_t value, std::string_view what, std::size_t bytes) const;

  TextCursor cursor_;
  bool binary_ = false;
  bool swapped_ = false;
};

}  // namespace hiac::formats::gmsh
