#pragma once

#include <cstddef>
#include <cstdint>

namespace hiac {

/// A file without a name, in memory, which a process and its children share. Nobody can make it
/// shorter, so that what is mapped of it stays valid. used_memory() counts what is written to it.
class SharedMemory {
 public:
  /// Empty at first. Throws std::bad_alloc when the system has no more of them.
  SharedMemory();
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// Bytes from the first to the last.
  [[nodiscard]] std::size_t size() const;
  /// Gives the whole pages of [begin, end) back; they hold zeros then, as the rest of the range.
  void discard(std::size_t begin, std::size_t end) const;

 private:
  int descriptor_;
  std::size_t slot_;
};

/// Bytes that all of them take in this process. Allocates nothing.
std::uint64_t bytes_in_shared_memory();

}  // namespace hiac
