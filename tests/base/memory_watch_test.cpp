#include "hiac/base/process/memory_watch.hpp"

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "hiac/base/process/child_process.hpp"

namespace hiac {
namespace {

constexpr std::size_t kMebibyte = 1 << 20;

// Whether something comes true within ten seconds.
bool becomes(const std::atomic<bool>& flag) {
  for (int turn = 0; turn < 1000 && !flag; ++turn)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return flag;
}

TEST(MemoryWatch, CountsWhatIsWrittenTo) {
  const std::uint64_t before = used_memory();
  ASSERT_GT(before, 0U);
  std::string reserved;
  reserved.reserve(512 * kMebibyte);
  EXPECT_LT(used_memory(), before + 64 * kMebibyte);
  const std::string written(256 * kMebibyte, 'x');
  EXPECT_GT(used_memory(), before + 250 * kMebibyte);
  EXPECT_LT(used_memory(), machine_memory());
}

TEST(MemoryWatch, CallsOnceAboveTheLimit) {
  std::atomic<bool> exceeded = false;
  std::atomic<int> calls = 0;
  const MemoryWatch watch(used_memory() + 128 * kMebibyte, [&] {
    exceeded = true;
    ++calls;
  });
  const std::string small(32 * kMebibyte, 'x');
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_FALSE(exceeded);
  const std::string large(256 * kMebibyte, 'x');
  EXPECT_TRUE(becomes(exceeded));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(calls, 1);
  EXPECT_GT(watch.peak(), 128 * kMebibyte);
}

TEST(MemoryWatch, CountsChildren) {
  std::atomic<bool> exceeded = false;
  const MemoryWatch watch(used_memory() + 128 * kMebibyte, [&] { exceeded = true; });
  in_child_process([] {
    const std::string large(256 * kMebibyte, 'x');
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    return large.substr(0, 1);
  });
  EXPECT_TRUE(exceeded);
}

}  // namespace
}  // namespace hiac
