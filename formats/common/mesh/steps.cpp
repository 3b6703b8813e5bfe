#include "formats/common/mesh/steps.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

/// Listings print six digits.
constexpr double kSameTime = 1e-6;
/// Error messages name at most so many times.
constexpr std::size_t kNamedTimes = 20;

std::size_t step_of_time(double time, std::span<const double> times, const std::string& subject) {
  if (times.empty()) throw UsageError(fmt::format("time {}: {} tells no time", time, subject));
  const auto nearest = std::min_element(times.begin(), times.end(), [time](double a, double b) {
    return std::abs(a - time) < std::abs(b - time);
  });
  const double slack = kSameTime * std::max(std::abs(time), std::abs(*nearest));
  if (!(std::abs(*nearest - time) <= slack))
    throw UsageError(
        fmt::format("time {}: {} has no such time (one of {}{} expected)", time, subject,
                    fmt::join(times.first(std::min(times.size(), kNamedTimes)), " "),
                    times.size() > kNamedTimes ? fmt::format(" ... {}", times.back()) : ""));
  return static_cast<std::size_t>(nearest - times.begin());
}

}  // namespace

std::optional<std::size_t> requested_step(const ReadOptions& options, std::span<const double> times,
                                          const std::string& subject) {
  if (options.time) return step_of_time(*options.time, times, subject);
  if (!options.step) return std::nullopt;
  // a file without times holds one step
  const std::size_t steps = std::max<std::size_t>(times.size(), 1);
  if (*options.step >= steps)
    throw UsageError(fmt::format("step {}: {} has no such step (0 to {} expected)", *options.step,
                                 subject, steps - 1));
  return options.step;
}

std::string last_step_note(std::size_t steps, double time) {
  return fmt::format(
      "took the last of {} steps, time {} (ReadOptions::step and "
      "ReadOptions::time take another)",
      steps, time);
}

}  // namespace hiac::formats
