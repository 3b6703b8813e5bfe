#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

namespace hiac {

/// Bytes of memory that this process and its children use now: what they have written to, not what
/// they have reserved, and not the files that they map; SharedMemory once, whoever maps it. 0 where
/// the system does not tell.
std::uint64_t used_memory();

/// Bytes of memory that the machine, or the control group of this process, has.
std::uint64_t machine_memory();

/// Looks often, from a thread of its own, how much memory the process and its children use, and
/// calls `exceeded` once when it is more than `limit` bytes. Lives as long as it is to watch. The
/// thread allocates no memory once this is constructed, so that the process may fork.
class MemoryWatch {
 public:
  MemoryWatch(std::uint64_t limit, std::function<void()> exceeded);
  ~MemoryWatch();
  MemoryWatch(const MemoryWatch&) = delete;
  MemoryWatch& operator=(const MemoryWatch&) = delete;

  /// The most that was found so far, in bytes.
  [[nodiscard]] std::uint64_t peak() const { return peak_; }

 private:
  void watch();

  std::uint64_t limit_;
  std::function<void()> exceeded_;
  std::mutex mutex_;
  std::condition_variable stop_;
  bool stopped_ = false;
  std::atomic<std::uint64_t> peak_{0};
  std::thread thread_;
};

}  // namespace hiac
