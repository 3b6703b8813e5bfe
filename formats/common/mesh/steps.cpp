#include "formats/common/mesh/steps.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

/// Listings print six digits.
constexpr double kSameTime = 1e-6;

/// The times before and after a time that the file does not have.
std::string neighbours(double time, std::span<const double> times) {
  std::optional<double> before, after;
  for (const double t : times) {
    if (t < time && (!before || t > *before)) before = t;
    if (t > time && (!after || t < *after)) after = t;
  }
  if (before && after) return fmt::format("{} and {}", time_text(*before), time_text(*after));
  return before ? fmt::format("{}, the last", time_text(*before))
                : fmt::format("{}, the first", time_text(*after));
}

std::size_t step_of_time(const ReadOptions& options, std::span<const double> times,
                         const std::string& subject) {
  const double time = *options.time;
  if (times.empty())
    throw UsageError(fmt::format("time {}: {} tells no time", time_text(time), subject));
  const auto nearest = std::min_element(times.begin(), times.end(), [time](double a, double b) {
    return std::abs(a - time) < std::abs(b - time);
  });
  const double slack = kSameTime * std::max(std::abs(time), std::abs(*nearest));
  if (!options.nearest_time && !(std::abs(*nearest - time) <= slack))
    throw UsageError(
        fmt::format("time {}: {} has no such time (its neighbours are {}; "
                    "ReadOptions::nearest_time takes the nearest)",
                    time_text(time), subject, neighbours(time, times)));
  return static_cast<std::size_t>(nearest - times.begin());
}

}  // namespace

std::optional<std::size_t> requested_step(const ReadOptions& options, std::span<const double> times,
                                          const std::string& subject) {
  if (options.time) return step_of_time(options, times, subject);
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
      steps, time_text(time));
}

std::string time_text(double time) {
  // the times that a solver sums up, or stores in fewer digits, differ from the intended number in
  // the sixteenth digit
  return fmt::format("{:.15g}", time);
}

}  // namespace hiac::formats
