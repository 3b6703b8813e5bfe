#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// The step that the options ask for by --time or --step; none when they ask for none. Times agree
/// when they differ by less than a millionth of themselves, since listings round them; of several
/// that do, the nearest is taken. Throws UsageError naming the steps that there are.
std::optional<std::size_t> requested_step(const ReadOptions& options, std::span<const double> times,
                                          const std::string& subject);

/// What a reader says that took the last of several steps unasked.
std::string last_step_note(std::size_t steps, double time);

}  // namespace hiac::formats
