#pragma once

#include "hiac/base/progress.hpp"

namespace hiac {

/// What may stop the work of this thread; none: nothing. parallel_for hands it on to its threads
/// and throws Cancelled before any further range when it is requested.
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

/// Throws Cancelled when the current cancellation is requested. It costs a few loads: a long
/// sequential loop asks every few thousand cheap steps, or before each costly one.
void check_cancelled();

/// Asks for a loop of cheap steps: check_cancelled() once in 4096 calls.
class CancellationCheck {
 public:
  void operator()() {
    if ((++steps_ & 4095U) == 0) check_cancelled();
  }

 private:
  unsigned steps_ = 0;
};

}  // namespace hiac
