#include "hiac/base/process/memory_watch.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "hiac/base/process/shared_memory.hpp"
#include "hiac/base/process/side_thread.hpp"

namespace hiac {
namespace {

constexpr std::uint64_t kKibibyte = 1024;
/// Memory is filled at a few gigabytes a second: little can be missed in so short a time.
constexpr auto kPause = std::chrono::milliseconds(20);

// A small file of the system; no memory is allocated for it, so that a fork in another thread does
// no harm.
class SystemText {
 public:
  explicit SystemText(const char* path) {
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0) return;
    const ssize_t count = read(file, bytes_.data(), bytes_.size());
    size_ = count > 0 ? static_cast<std::size_t>(count) : 0;
    close(file);
  }
  [[nodiscard]] std::string_view text() const { return {bytes_.data(), size_}; }

 private:
  std::array<char, 8192> bytes_;
  std::size_t size_ = 0;
};

/// The number after some blanks; 0 for none.
std::uint64_t number_at(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  std::uint64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// The sum of the lines of a process's status that count memory of its own. What processes share is
/// counted once, by bytes_in_shared_memory.
std::uint64_t memory_of(const char* status_path) {
  const SystemText status(status_path);
  std::uint64_t sum = 0;
  for (const std::string_view counted : {"\nRssAnon:", "\nVmSwap:"})
    if (const std::size_t at = status.text().find(counted); at != std::string_view::npos)
      sum += number_at(status.text().substr(at + counted.size()));
  return sum * kKibibyte;
}

std::uint64_t number_in(const char* path) {
  std::ifstream file(path);
  std::uint64_t number = 0;
  return file >> number ? number : std::numeric_limits<std::uint64_t>::max();
}

}  // namespace

std::uint64_t used_memory() {
  std::uint64_t sum = memory_of("/proc/self/status") + bytes_in_shared_memory();
  std::array<char, 64> path{};
  std::snprintf(path.data(), path.size(), "/proc/self/task/%d/children", getpid());
  const SystemText children(path.data());
  std::string_view rest = children.text();
  while (const std::uint64_t child = number_at(rest)) {
    std::snprintf(path.data(), path.size(), "/proc/%llu/status",
                  static_cast<unsigned long long>(child));
    sum += memory_of(path.data());
    rest.remove_prefix(std::min(rest.find(' ') + 1, rest.size()));
  }
  return sum;
}

std::uint64_t machine_memory() {
  const auto machine = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                       static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return std::min({machine, number_in("/sys/fs/cgroup/memory.max"),
                   number_in("/sys/fs/cgroup/memory/memory.limit_in_bytes")});
}

MemoryWatch::MemoryWatch(std::uint64_t limit, std::function<void()> exceeded)
    : limit_(limit),
      exceeded_(std::move(exceeded)),
      peak_(used_memory()),
      thread_(start_side_thread([this] { watch(); })) {}

MemoryWatch::~MemoryWatch() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  stop_.notify_all();
  thread_.join();
}

void MemoryWatch::watch() {
  std::unique_lock lock(mutex_);
  while (!stop_.wait_for(lock, kPause, [this] { return stopped_; })) {
    const std::uint64_t used = used_memory();
    peak_ = std::max(peak_.load(), used);
    if (used <= limit_) continue;
    exceeded_();
    return;
  }
}

}  // namespace hiac
