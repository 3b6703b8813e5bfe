#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <thread>

namespace hiac::test {

/// Returns the number of threads that this process has.
inline std::ptrdiff_t threads_here() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
}

/// Returns whether this process has one thread, at once or within seconds: a thread that has ended
/// can be seen for a moment longer.
inline bool one_thread_remains() {
  for (int pause = 0; pause < 1000; ++pause) {
    if (threads_here() == 1) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

}  // namespace hiac::test
