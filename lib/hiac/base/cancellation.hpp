#pragma once

#include "hiac/base/progress.hpp"

namespace hiac {

/// Returns the object that may cancel the work of this thread, or null. parallel_for passes it to
/// its threads, and throws Cancelled before it starts another range once cancellation is requested.
const Cancellation* current_cancellation();

/// Makes `cancellation` (which may be null) the current one of this thread while the object lives.
class CancellationScope {
 public:
  explicit CancellationScope(const Cancellation* cancellation);
  ~CancellationScope();
  CancellationScope(const CancellationScope&) = delete;
  CancellationScope& operator=(const CancellationScope&) = delete;

 private:
  const Cancellation* before_;
};

/// Throws Cancelled if the current cancellation is requested. It costs a few loads: call it every
/// few thousand cheap steps of a long sequential loop, or before each costly step.
void check_cancelled();

/// Tests for cancellation in a loop of cheap steps: calls check_cancelled() once in 4096 calls.
class CancellationCheck {
 public:
  void operator()() {
    if ((++steps_ & 4095U) == 0) check_cancelled();
  }

 private:
  unsigned steps_ = 0;
};

}  // namespace hiac
