#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hiac {

/// Where a packed block may begin: a multiple of the size of a page on every machine.
inline constexpr std::size_t kPackPage = std::size_t{1} << 16;

/// Writes numbers, texts and arrays one after the other into a file, for a PackReader of the same
/// program: the layout need not stay stable. Every item begins at a multiple of eight bytes.
class PackWriter {
 public:
  /// Writes from byte `begin` of the file on, a multiple of kPackPage.
  explicit PackWriter(int descriptor, std::size_t begin = 0)
      : descriptor_(descriptor), at_(begin) {}

  /// The first byte behind what has been written.
  [[nodiscard]] std::size_t end() const { return at_; }

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
  /// Writes bytes that a reader can map (PackReader::block), and gives back their memory on the
  /// way: afterwards they may only be freed.
  void consume_block(void* data, std::size_t count);

 private:
  /// Throws std::bad_alloc when the file cannot grow.
  void bytes(const void* data, std::size_t count);
  void write_all(const char* data, std::size_t count);
  void pad(std::size_t alignment);

  int descriptor_;
  std::size_t at_;
};

/// Reads what a PackWriter wrote.
class PackReader {
 public:
  /// Errors name `subject`.
  PackReader(std::span<const char> bytes, std::string subject)
      : all_(bytes), rest_(bytes), subject_(std::move(subject)) {}

  std::uint64_t number();
  /// A number that is less than `limit`.
  std::uint64_t number_below(std::uint64_t limit);
  std::string text();
  /// A text where it lies.
  std::span<const char> text_bytes();
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
  /// The bytes of PackWriter::consume_block, where they lie: whole pages, which nothing else is in.
  std::span<const char> block();

  /// Throws InputError: what was read cannot be right.
  [[noreturn]] void fail() const;

 private:
  std::span<const char> take(std::size_t size);
  void skip_to_page();

  std::span<const char> all_;
  std::span<const char> rest_;
  std::string subject_;
};

}  // namespace hiac
