#include "hiac/base/process/child_process.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hiac {
namespace {

TEST(ChildProcess, ReturnsWhatItsWorkReturns) {
  EXPECT_EQ(in_child_process([] { return std::string("an answer"); }), "an answer");
  EXPECT_EQ(in_child_process([] { return std::string(); }), "");
  const std::string long_one(3'000'000, 'x');  // more than a pipe holds
  EXPECT_EQ(in_child_process([&] { return long_one; }), long_one);
}

TEST(ChildProcess, TakesItsEndWithIt) {
  EXPECT_EQ(in_child_process([]() -> std::string { _exit(0); }), "");
  EXPECT_EQ(in_child_process([]() -> std::string { _exit(3); }), std::nullopt);
  EXPECT_EQ(in_child_process([]() -> std::string { throw std::runtime_error("no"); }),
            std::nullopt);
  EXPECT_EQ(in_child_process([]() -> std::string {
              std::signal(SIGSEGV, SIG_DFL);
              std::raise(SIGSEGV);
              return "";
            }),
            std::nullopt);
}

TEST(ChildProcess, StaysWithinItsLimits) {
  constexpr std::size_t kMebibyte = 1 << 20;
  const auto take = [](std::size_t bytes) {
    return [bytes] { return std::to_string(std::string(bytes, 'x').size()); };
  };
  EXPECT_EQ(in_child_process(take(64 * kMebibyte), {.memory_bytes = 256 * kMebibyte}), "67108864");
  EXPECT_EQ(in_child_process(take(512 * kMebibyte), {.memory_bytes = 256 * kMebibyte}),
            std::nullopt);
  const auto for_ever = []() -> std::string {
    for (std::atomic<int> turns{0};; ++turns) continue;
  };
  EXPECT_EQ(in_child_process(for_ever, {.seconds = 1}), std::nullopt);
}

TEST(ChildProcess, EndsWithItsParent) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  const pid_t parent = fork();
  if (parent == 0) {
    in_child_process([] {
      sleep(60);
      return std::string();
    });
    _exit(0);
  }
  close(ends[1]);  // the parent and its child hold the other copies
  usleep(200'000);
  kill(parent, SIGTERM);
  waitpid(parent, nullptr, 0);
  pollfd ended{ends[0], POLLIN, 0};
  EXPECT_EQ(poll(&ended, 1, 10'000), 1) << "the child lives on";
  close(ends[0]);
}

TEST(ChildProcess, ChangesNothingHere) {
  int value = 1;
  in_child_process([&] {
    value = 2;
    return std::string();
  });
  EXPECT_EQ(value, 1);
}

}  // namespace
}  // namespace hiac
