#include "formats/common/mesh/field_steps.hpp"

#include <fmt/format.h>

#include "formats/common/mesh/steps.hpp"

namespace hiac::formats {
namespace {

/// "0, 2 to 5".
std::string listed(const std::set<std::size_t>& steps) {
  std::string text;
  for (auto first = steps.begin(); first != steps.end();) {
    auto last = first;
    auto next = std::next(first);
    for (; next != steps.end() && *next == *last + 1; ++next) last = next;
    if (!text.empty()) text += ", ";
    text += first == last         ? fmt::format("{}", *first)
            : *last == *first + 1 ? fmt::format("{}, {}", *first, *last)
                                  : fmt::format("{} to {}", *first, *last);
    first = next;
  }
  return text;
}

}  // namespace

void note_absent_fields(const FieldSteps& fields, std::span<const double> times, std::size_t step,
                        std::vector<std::string>& notes) {
  for (const auto& [name, steps] : fields)
    if (!steps.empty() && !steps.contains(step))
      notes.push_back(
          fmt::format("field '{}' is absent at step {}, time {}: it has values at {} {}", name,
                      step, step < times.size() ? time_text(times[step]) : "unknown",
                      steps.size() == 1 ? "step" : "steps", listed(steps)));
}

void note_partial_fields(const FieldSteps& fields, std::size_t steps,
                         std::vector<std::string>& notes) {
  for (const auto& [name, own] : fields)
    if (!own.empty() && own.size() < steps)
      notes.push_back(fmt::format("field '{}' has values at {} of {} steps: {}", name, own.size(),
                                  steps, listed(own)));
}

}  // namespace hiac::formats
