#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hiac::formats {

/// Writes numbers, texts and arrays one after the other into a file, for a PackReader of the same
/// program: the layout need not stay stable. Every item begins at a multiple of eight bytes.
class PackWriter {
 public:
  explicit PackWriter(int descriptor) : descriptor_(descriptor) {}

  void number(std::uint64_t value) { bytes(&value, sizeof value); }
  void text(std::string_view value);
  template <typename T>
  void array(std::span<const T> values) {
    number(values.size());
    bytes(values.data(), values.size_bytes());
  }
  /// Writes the values and frees their memory.
  template <typename T>
  void consume(std::vector<T>& values) {
    array(std::span<const T>(values));
    values = std::vector<T>();
  }

 private:
  /// Throws std::bad_alloc when the file cannot grow.
  void bytes(const void* data, std::size_t count);

  int descriptor_;
};

/// Reads what a PackWriter wrote.
class PackReader {
 public:
  /// Errors name `subject`.
  PackReader(std::span<const char> bytes, std::string subject)
      : rest_(bytes), subject_(std::move(subject)) {}

  std::uint64_t number();
  std::string text();
  template <typename T>
  std::vector<T> array() {
    const std::uint64_t count = number();
    if (count > rest_.size() / sizeof(T)) fail();
    const std::span<const char> part = take(count * sizeof(T));
    const auto* first = reinterpret_cast<const T*>(part.data());
    return {first, first + count};
  }
  /// A count of items that follow, each of at least eight bytes.
  std::size_t count();

 private:
  std::span<const char> take(std::size_t size);
  [[noreturn]] void fail() const;

  std::span<const char> rest_;
  std::string subject_;
};

}  // namespace hiac::formats
