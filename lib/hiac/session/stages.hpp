#pragma once

#include <string>
#include <utility>

#include "hiac/base/cancellation.hpp"
#include "hiac/base/seconds.hpp"
#include "hiac/session/session.hpp"

namespace hiac {

/// Reports one stage to a monitor for as long as the object lives.
class StageClock {
 public:
  StageClock(const Monitor& monitor, std::string name)
      : monitor_(monitor), name_(std::move(name)), start_(seconds_now()) {
    if (monitor_.progress != nullptr) monitor_.progress->begin(name_);
  }
  ~StageClock() {
    if (monitor_.stage_ended) monitor_.stage_ended(name_, seconds_now() - start_);
  }
  StageClock(const StageClock&) = delete;
  StageClock& operator=(const StageClock&) = delete;

 private:
  const Monitor& monitor_;
  std::string name_;
  double start_;
};

/// Runs one stage of the work under a monitor and returns what it returns; throws Cancelled before
/// it, during it and after it.
template <typename Stage>
auto run_stage(const Monitor& monitor, const std::string& name, Stage&& stage) {
  const CancellationScope scope(monitor.cancellation);
  check_cancelled();
  const StageClock clock(monitor, name);
  auto result = std::forward<Stage>(stage)();
  check_cancelled();
  return result;
}

}  // namespace hiac
