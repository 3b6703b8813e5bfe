#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// The step that --time or --step requests; none when neither is given. Times agree when their
/// relative difference is below a millionth, because listings round them; if several steps agree,
/// the nearest is taken, and with `nearest_time` the nearest step is taken at any distance. Throws
/// UsageError naming the times before and after.
std::optional<std::size_t> requested_step(const ReadOptions& options, std::span<const double> times,
                                          const std::string& subject);

/// A time as text in 15 digits, so that 0.1 + 0.2 is 0.3.
std::string time_text(double time);

/// The note of a reader that took the last of several steps because none was requested.
std::string last_step_note(std::size_t steps, double time);

}  // namespace hiac::formats
