#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// The step that the options ask for by --time or --step; none when they ask for none. Times agree
/// when their relative difference is below a millionth, because listings round them; the nearest of
/// several such steps is taken, and with `nearest_time` whatever is nearest. Throws UsageError
/// naming the times before and after.
std::optional<std::size_t> requested_step(const ReadOptions& options, std::span<const double> times,
                                          const std::string& subject);

/// A time as it is told: in 15 digits, so that 0.1 + 0.2 is 0.3.
std::string time_text(double time);

/// The note of a reader that took the last of several steps without a request.
std::string last_step_note(std::size_t steps, double time);

}  // namespace hiac::formats
