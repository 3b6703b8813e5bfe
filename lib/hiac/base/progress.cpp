#include "hiac/base/progress.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "hiac/base/seconds.hpp"

namespace hiac {

void Progress::begin(std::string stage, std::uint64_t total) {
  const std::scoped_lock lock(mutex_);
  stage_ = std::move(stage);
  total_ = total;
  start_ = seconds_now();
  done_.store(0, std::memory_order_relaxed);
}

Progress::State Progress::state() const {
  const std::scoped_lock lock(mutex_);
  if (stage_.empty()) return {};
  const std::uint64_t done = done_.load(std::memory_order_relaxed);
  return {stage_, total_, total_ == 0 ? done : std::min(done, total_), seconds_now() - start_};
}

std::optional<double> seconds_left(double done, double total, double seconds) {
  if (!(done > 0) || !(done <= total)) return std::nullopt;
  return seconds * (total - done) / done;
}

std::string duration_text(double seconds) {
  constexpr double kMost = 1e9;  // longer than a lifetime
  const auto whole = static_cast<std::uint64_t>(std::llround(std::clamp(seconds, 0.0, kMost)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace hiac
