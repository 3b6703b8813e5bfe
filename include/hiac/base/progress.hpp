#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

namespace hiac {

/// The progress of a long computation. The working threads report it; another thread may read it at
/// any time. A report costs one relaxed addition: report about once per tile, not in inner loops.
class Progress {
 public:
  /// Begins a stage of `total` units of about equal cost; 0 if the number is unknown.
  void begin(std::string stage, std::uint64_t total = 0);
  /// Reports that more units of the stage are done. Any thread may call it.
  void advance(std::uint64_t units = 1) { done_.fetch_add(units, std::memory_order_relaxed); }

  struct State {
    std::string stage;        ///< empty before the first stage
    std::uint64_t total = 0;  ///< 0: unknown
    std::uint64_t done = 0;   ///< at most `total` when that is known
    double seconds = 0;       ///< since the stage began
  };
  [[nodiscard]] State state() const;

 private:
  mutable std::mutex mutex_;  // guards all but done_
  std::string stage_;
  std::uint64_t total_ = 0;
  double start_ = 0;
  std::atomic<std::uint64_t> done_{0};
};

/// A request to stop a long computation. Any thread may make it, and so may a signal handler. The
/// computation soon ends by throwing Cancelled, and leaves its inputs as they were, so that it may
/// be started again.
class Cancellation {
 public:
  void request() { requested_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool requested() const { return requested_.load(std::memory_order_relaxed); }
  /// Withdraws the request, before the computation is started again.
  void reset() { requested_.store(false, std::memory_order_relaxed); }

 private:
  std::atomic<bool> requested_{false};
};

/// Thrown by a computation that was asked to stop. It is not an Error, as nothing is wrong.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

/// Returns the seconds that remain if `done` of `total` took `seconds`; none if that is unknown.
std::optional<double> seconds_left(double done, double total, double seconds);

/// Formats a duration for people, rounded: "4 s", "1 min 20 s", "3 h 5 min".
std::string duration_text(double seconds);

}  // namespace hiac
