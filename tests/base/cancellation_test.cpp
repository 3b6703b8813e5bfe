#include "hiac/base/cancellation.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/parallel.hpp"
#include "hiac/base/parallel_sort.hpp"

namespace hiac {
namespace {

TEST(Cancellation, WithoutARequestNothingStops) {
  const Cancellation cancellation;
  const CancellationScope scope(&cancellation);
  std::atomic<int> ranges{0};
  parallel_for(1000, 1, [&](IndexRange) { ++ranges; });
  EXPECT_EQ(ranges, 1000);
  EXPECT_NO_THROW(check_cancelled());
}

TEST(Cancellation, AParallelLoopBeginsNoFurtherRange) {
  Cancellation cancellation;
  const CancellationScope scope(&cancellation);
  std::atomic<int> ranges{0};
  EXPECT_THROW(parallel_for(100000, 1,
                            [&](IndexRange) {
                              if (++ranges == 10) cancellation.request();
                            }),
               Cancelled);
  // those that were under way on other threads may have ended
  EXPECT_LT(ranges, 10 + static_cast<int>(thread_count()) * 2);
  cancellation.reset();
  EXPECT_NO_THROW(parallel_for(10, 1, [&](IndexRange) {}));
}

TEST(Cancellation, LoopsInsideLoopsKnowIt) {
  Cancellation cancellation;
  const CancellationScope scope(&cancellation);
  std::atomic<int> without{0};
  EXPECT_THROW(parallel_for(64, 1,
                            [&](IndexRange range) {
                              if (current_cancellation() != &cancellation) ++without;
                              if (range.begin == 40) cancellation.request();
                              parallel_for(1000, 1, [&](IndexRange) {
                                if (current_cancellation() != &cancellation) ++without;
                              });
                            }),
               Cancelled);
  EXPECT_EQ(without, 0);
}

// A thread that waits for one loop may run ranges of another: each has its own cancellation.
TEST(Cancellation, StopsTheWorkItWasGivenToAlone) {
  Cancellation stopped;
  stopped.request();
  std::atomic<bool> failed{false};
  std::thread other([&] {
    for (int i = 0; i < 200; ++i) try {
        parallel_for(200, 1, [&](IndexRange) { check_cancelled(); });
      } catch (const Cancelled&) {
        failed = true;
      }
  });
  for (int i = 0; i < 200; ++i) {
    const CancellationScope scope(&stopped);
    EXPECT_THROW(parallel_for(200, 1, [&](IndexRange) {}), Cancelled);
  }
  other.join();
  EXPECT_FALSE(failed);
  EXPECT_EQ(current_cancellation(), nullptr);
  EXPECT_NO_THROW(check_cancelled());
}

TEST(Cancellation, ASortStopsAndIsRightWhenRepeated) {
  Cancellation cancellation;
  const CancellationScope scope(&cancellation);
  std::vector<unsigned> numbers(1 << 18);
  std::iota(numbers.begin(), numbers.end(), 0U);
  std::ranges::sort(numbers, {}, [](unsigned n) { return n * 2654435761U; });
  std::atomic<int> compared{0};
  EXPECT_THROW(parallel_sort(numbers,
                             [&](unsigned a, unsigned b) {
                               if (++compared == 5000) cancellation.request();
                               return a < b;
                             }),
               Cancelled);
  EXPECT_LT(compared, 5000 + static_cast<int>(thread_count()) * 2);
  cancellation.reset();
  parallel_sort(numbers, std::less<>());
  EXPECT_TRUE(std::ranges::is_sorted(numbers));
  EXPECT_EQ(std::ranges::adjacent_find(numbers), numbers.end());  // none lost
}

TEST(Cancellation, LoopsOfCheapStepsAskNowAndThen) {
  Cancellation cancellation;
  const CancellationScope scope(&cancellation);
  cancellation.request();
  CancellationCheck check;
  int steps = 0;
  EXPECT_THROW(for (;; ++steps) check(), Cancelled);
  EXPECT_LT(steps, 4096);
}

}  // namespace
}  // namespace hiac
