#pragma once

#include <chrono>

namespace hiac {

/// Returns the seconds since some fixed moment, by a clock that is never set back.
inline double seconds_now() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

}  // namespace hiac
