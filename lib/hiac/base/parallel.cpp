#include "hiac/base/parallel.hpp"

#include <algorithm>
#include <new>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>

#include "hiac/base/cancellation.hpp"

namespace hiac {

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(IndexRange)>& body) {
  if (count == 0) return;
  const std::size_t step = std::max<std::size_t>(grain, 1);
  const std::size_t chunks = (count + step - 1) / step;
  // every chunk sets it: a thread that waits in another loop may run a chunk of this one
  const Cancellation* const cancellation = current_cancellation();
  oneapi::tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
    const CancellationScope scope(cancellation);
    check_cancelled();
    body({chunk * step, std::min(count, (chunk + 1) * step)});
  });
}

struct ThreadLimit::Control {
  oneapi::tbb::global_control control;
};

ThreadLimit::ThreadLimit(unsigned threads)
    : control_(threads == 0 ? nullptr
                            : new Control{oneapi::tbb::global_control(
                                  oneapi::tbb::global_control::max_allowed_parallelism, threads)}) {
}

ThreadLimit::~ThreadLimit() { delete control_; }

unsigned thread_count() {
  const auto limit = oneapi::tbb::global_control::active_value(
      oneapi::tbb::global_control::max_allowed_parallelism);
  return static_cast<unsigned>(std::max<std::size_t>(1, limit));
}

void end_waiting_threads() {
  oneapi::tbb::task_scheduler_handle threads{oneapi::tbb::attach{}};
  oneapi::tbb::finalize(threads, std::nothrow);
}

}  // namespace hiac
