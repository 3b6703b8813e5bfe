#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace hiac {

/// Whole pages of memory from the system: aligned, not touched before they are filled, and grown
/// without copying. The destructor gives them back.
class PageBuffer {
 public:
  PageBuffer() = default;
  ~PageBuffer();
  PageBuffer(const PageBuffer&) = delete;
  PageBuffer& operator=(const PageBuffer&) = delete;

  /// Makes it `size` bytes long, not 0; what was written stays, elsewhere perhaps, and the rest is
  /// 0. Throws std::bad_alloc.
  void grow(std::size_t size);
  [[nodiscard]] std::span<std::uint8_t> bytes() const {
    return {static_cast<std::uint8_t*>(data_), size_};
  }

 private:
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace hiac
