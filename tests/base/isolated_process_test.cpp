#include "hiac/base/process/isolated_process.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <latch>
#include <new>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/base/process/memory_watch.hpp"
#include "hiac/base/process/side_thread.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/threads.hpp"

namespace hiac {
namespace {

using testing::HasSubstr;

constexpr std::size_t kMebibyte = std::size_t{1} << 20;

/// Does what the request names.
void serve(const std::string& path, const std::string& request, PackWriter& out) {
  if (request == "bad input") throw InputError(path, "is bad");
  if (request == "wrong usage") throw UsageError("wrong");
  if (request == "no memory") throw std::bad_alloc();
  if (request == "crash") std::raise(SIGSEGV);
  if (request == "leave") _exit(7);
  if (request == "speak") std::fputs("this is not to be seen\n", stderr);
  out.text(path + " " + request);
  std::vector<double> numbers(request == "much" ? 4 * kMebibyte : 3);
  std::iota(numbers.begin(), numbers.end(), 0.5);
  out.consume_block(numbers.data(), numbers.size() * sizeof(double));
  out.number(42);
}

std::string text_of(IsolatedProcess& process, const std::string& request) {
  const PackedAnswer answer = process.answer("file", request);
  return PackReader(answer.bytes(), "file").text();
}

std::string message_of(IsolatedProcess& process, const std::string& request) {
  try {
    process.answer("file", request);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(IsolatedProcess, AnswersRequestAfterRequest) {
  IsolatedProcess process("a library", serve);
  for (const char* request : {"first", "speak", "third"})
    EXPECT_EQ(text_of(process, request), std::string("file ") + request);
}

TEST(IsolatedProcess, PassesErrorsOn) {
  IsolatedProcess process("a library", serve);
  EXPECT_EQ(message_of(process, "bad input"), "file: is bad");
  EXPECT_THROW(process.answer("file", "wrong usage"), UsageError);
  EXPECT_THROW(process.answer("file", "no memory"), std::bad_alloc);
  EXPECT_EQ(text_of(process, "again"), "file again");
}

TEST(IsolatedProcess, ContainsACrash) {
  IsolatedProcess process("a library", serve);
  for (int round = 0; round < 2; ++round)
    EXPECT_THAT(message_of(process, "crash"),
                HasSubstr("file: a library breaks down on it (a damaged file; signal 11)"));
  IsolatedProcess other("a library", serve);
  EXPECT_THAT(message_of(other, "leave"), HasSubstr("status 7"));
}

TEST(IsolatedProcess, BlocksOutliveTheirAnswer) {
  const std::uint64_t before = bytes_in_shared_memory();
  {
    IsolatedProcess process("a library", serve);
    double* numbers = nullptr;
    {
      PackedAnswer answer = process.answer("file", "much");
      PackReader in(answer.bytes(), "file");
      in.text();
      const std::span<const char> block = in.block();
      ASSERT_EQ(block.size(), 4 * kMebibyte * sizeof(double));
      EXPECT_EQ(in.number(), 42U);
      numbers = static_cast<double*>(answer.take_block(block));
    }
    EXPECT_EQ(text_of(process, "next"), "file next");
    EXPECT_EQ(numbers[0], 0.5);
    EXPECT_EQ(numbers[4 * kMebibyte - 1], 0.5 + static_cast<double>(4 * kMebibyte - 1));
    numbers[1] = 7;  // it belongs to whoever took it
    EXPECT_EQ(numbers[1], 7);
    const std::uint64_t held = bytes_in_shared_memory() - before;
    EXPECT_GE(held, 32 * kMebibyte);
    EXPECT_LT(held, 33 * kMebibyte) << "answers are kept";
    free_block(numbers);
    EXPECT_LT(bytes_in_shared_memory() - before, kMebibyte) << "a block is kept";
  }
  EXPECT_EQ(bytes_in_shared_memory(), before);
}

TEST(IsolatedProcess, AnswersAreGivenBack) {
  const std::uint64_t before = bytes_in_shared_memory();
  IsolatedProcess process("a library", [](const std::string&, const std::string&, PackWriter& out) {
    out.array(std::span<const double>(std::vector<double>(kMebibyte, 1.5)));
  });
  for (int round = 0; round < 3; ++round) {
    const PackedAnswer answer = process.answer("file", "");
    EXPECT_EQ(PackReader(answer.bytes(), "file").array<double>().size(), kMebibyte);
    EXPECT_LT(bytes_in_shared_memory() - before, 9 * kMebibyte) << round;
  }
  EXPECT_LT(bytes_in_shared_memory() - before, kMebibyte);
}

TEST(IsolatedProcess, SharedMemoryIsCountedOnce) {
  const std::uint64_t before = used_memory();
  IsolatedProcess process("a library", [](const std::string&, const std::string&, PackWriter& out) {
    std::string bytes(256 * kMebibyte, 'x');
    out.consume_block(bytes.data(), bytes.size());
  });
  PackedAnswer answer = process.answer("file", "");
  PackReader in(answer.bytes(), "file");
  const std::span<const char> block = in.block();
  EXPECT_EQ(std::accumulate(block.begin(), block.end(), std::size_t{0}), block.size() * 'x');
  const std::uint64_t used = used_memory() - before;
  EXPECT_GT(used, 250 * kMebibyte);
  EXPECT_LT(used, 320 * kMebibyte);
}

// ---- what is packed, without a process

template <typename Write>
std::vector<char> packed(const Write& write) {
  const SharedMemory memory;
  PackWriter out(memory.descriptor());
  write(out);
  std::vector<char> bytes(out.end());
  EXPECT_EQ(pread(memory.descriptor(), bytes.data(), bytes.size(), 0),
            static_cast<ssize_t>(bytes.size()));
  return bytes;
}

// A thread that starts holds locks of the memory allocator, which a fork would copy.
TEST(IsolatedProcess, AnswersWhenTheWatchOverMemoryHasJustBegun) {
  for (std::size_t trial = 0; trial < test::tried(100); ++trial) {
    const MemoryWatch watch(std::uint64_t{1} << 40, [] {});
    IsolatedProcess process("a library", serve);
    EXPECT_EQ(text_of(process, "one"), "file one");
  }
}

TEST(IsolatedProcess, AnswersWhileAThreadBesideAllocates) {
  for (std::size_t trial = 0; trial < test::tried(100); ++trial) {
    std::atomic<bool> stopped = false;
    std::thread beside = start_side_thread([&] {
      while (!stopped) {
        const auto held = keep_from_forking();
        std::vector<std::string> texts(100, std::string(1000, 'x'));
      }
    });
    IsolatedProcess process("a library", serve);
    EXPECT_EQ(text_of(process, "one"), "file one");
    stopped = true;
    beside.join();
  }
}

TEST(IsolatedProcess, BeginsOnceNothingKeepsFromForking) {
  std::atomic<bool> held_still = true;
  std::latch holding(1);
  std::thread beside = start_side_thread([&] {
    const auto held = keep_from_forking();
    holding.count_down();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    held_still = false;
  });
  holding.wait();
  const IsolatedProcess process("a library", serve);
  EXPECT_FALSE(held_still);
  beside.join();
}

TEST(IsolatedProcess, BeginsOnceTheThreadsOfLoopsHaveEnded) {
  const ThreadLimit four(4);
  for (int trial = 0; trial < 20; ++trial) {
    std::atomic<std::size_t> sum = 0;
    parallel_for(64, 1, [&](IndexRange range) {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      sum += std::string(range.begin, 'x').size();
    });
    EXPECT_EQ(sum, 63U * 64 / 2);
    ASSERT_GT(test::threads_here(), 1);
    IsolatedProcess process("a library", serve);
    EXPECT_EQ(text_of(process, "one"), "file one");
    EXPECT_TRUE(test::one_thread_remains());
  }
}

TEST(Pack, GivesEverythingBack) {
  std::string large(100'000, 'y');
  const std::vector<char> bytes = packed([&](PackWriter& out) {
    out.number(5);
    out.text("seven b");
    out.array(std::span<const double>(std::vector{1.5, 2.5}));
    std::string copy = large;
    out.consume_block(copy.data(), copy.size());
    out.number(6);
  });
  PackReader in(bytes, "file");
  EXPECT_EQ(in.number_below(6), 5U);
  EXPECT_EQ(in.text(), "seven b");
  EXPECT_EQ(in.array<double>(), (std::vector{1.5, 2.5}));
  const std::span<const char> block = in.block();
  EXPECT_EQ(std::string(block.begin(), block.end()), large);
  EXPECT_EQ((block.data() - bytes.data()) % static_cast<std::ptrdiff_t>(kPackPage), 0);
  EXPECT_EQ(in.number(), 6U);
  EXPECT_THROW(in.number(), InputError);
}

TEST(Pack, RefusesWhatCannotBeRight) {
  const std::vector<char> bytes = packed([](PackWriter& out) { out.number(1000); });
  const auto reader = [&] { return PackReader(bytes, "file"); };
  EXPECT_THROW(reader().number_below(1000), InputError);
  EXPECT_EQ(reader().number_below(1001), 1000U);
  EXPECT_THROW(reader().text(), InputError);
  EXPECT_THROW(reader().array<double>(), InputError);
  EXPECT_THROW(reader().count(), InputError);
  EXPECT_THROW(reader().block(), InputError);
}

}  // namespace
}  // namespace hiac
