#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

namespace hiac {

/// How far a long piece of work has come. The threads that work tell; another one may ask at any
/// time. To tell costs one relaxed addition: do it once a tile or so, not in inner loops.
class Progress {
 public:
  /// Begins a stage of `total` units of about the same cost; 0: nobody knows how many.
  void begin(std::string stage, std::uint64_t total = 0);
  /// More units of the stage are done. From any thread.
  void advance(std::uint64_t units = 1) { done_.fetch_add(units, std::memory_order_relaxed); }

  struct State {
    std::string stage;        ///< empty before the first one
    std::uint64_t total = 0;  ///< 0: not known
    std::uint64_t done = 0;   ///< at most `total` where that is known
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

/// The seconds that are left when `done` of `total` took `seconds`; none where that is unknown.
std::optional<double> seconds_left(double done, double total, double seconds);

/// A length of time for people, rounded to what they would say: "4 s", "1 min 20 s", "3 h 5 min".
std::string duration_text(double seconds);

}  // namespace hiac
