#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "hiac/base/error.hpp"
#include "hiac/cluster/communicator.hpp"

namespace hiac {

/// Writes numbers one after the other. All processes of a run have one representation of them.
class ByteWriter {
 public:
  explicit ByteWriter(Bytes& bytes) : bytes_(bytes) {}

  template <typename T>
  void put(const T& value) {
    put_all(std::span(&value, 1));
  }
  /// Bytes of the message that the caller sets, before it puts anything else.
  std::byte* put_space(std::size_t size) {
    const std::size_t begin = bytes_.size();
    bytes_.resize(begin + size);
    return bytes_.data() + begin;
  }
  /// Without their number.
  template <typename T>
  void put_all(std::span<const T> values) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    if (values.empty()) return;
    std::memcpy(put_space(values.size_bytes()), values.data(), values.size_bytes());
  }

 private:
  Bytes& bytes_;
};

/// Reads what ByteWriter has written, in the same order. Throws Error (ExitCode::internal) where
/// there is less.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  [[nodiscard]] bool at_end() const { return bytes_.empty(); }

  template <typename T>
  T get() {
    T value;
    copy(&value, sizeof(T));
    return value;
  }
  /// Bytes that the caller of put_space has set.
  std::span<const std::byte> get_space(std::size_t size) {
    if (size > bytes_.size()) fail();
    const auto space = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return space;
  }
  template <typename T>
  std::vector<T> get_all(std::size_t count) {
    if (count > bytes_.size() / sizeof(T)) fail();
    std::vector<T> values(count);
    if (count > 0) copy(values.data(), count * sizeof(T));
    return values;
  }

 private:
  void copy(void* to, std::size_t size) { std::memcpy(to, get_space(size).data(), size); }
  [[noreturn]] static void fail() {
    throw Error(ExitCode::internal, "a message between processes ends too soon");
  }

  std::span<const std::byte> bytes_;
};

}  // namespace hiac
