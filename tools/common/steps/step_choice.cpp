#include "tools/common/steps/step_choice.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>
#include <system_error>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::tools {
namespace {

// Two or three numbers with colons between; how many there are, 0 where the text is something else.
std::size_t read_numbers(const std::string& text, std::array<std::size_t, 3>& numbers) {
  const char *at = text.data(), *const end = text.data() + text.size();
  for (std::size_t count = 0; count < numbers.size(); ++count) {
    const auto [next, error] = std::from_chars(at, end, numbers[count]);
    if (error != std::errc()) return 0;
    if (next == end) return count + 1;
    if (*next != ':') return 0;
    at = next + 1;
  }
  return 0;
}

}  // namespace

StepChoice::StepChoice(const std::string& text) : text_(text), all_(text == "all") {
  if (all_) return;
  std::array<std::size_t, 3> numbers{0, 0, 1};
  if (read_numbers(text, numbers) < 2)
    throw UsageError(fmt::format("--steps {}: {} expected", text, kStepsType));
  first_ = numbers[0];
  last_ = numbers[1];
  stride_ = numbers[2];
  if (first_ > last_) throw UsageError(fmt::format("--steps {}: FIRST is above LAST", text));
  if (stride_ == 0) throw UsageError(fmt::format("--steps {}: STRIDE is at least 1", text));
}

std::vector<std::size_t> StepChoice::among(std::span<const std::size_t> existing,
                                           const std::string& subject) const {
  if (all_) return {existing.begin(), existing.end()};
  std::vector<std::size_t> chosen;
  for (std::size_t step = first_;; step += stride_) {
    if (!std::ranges::binary_search(existing, step))
      throw UsageError(fmt::format("--steps {}: {} has no step {} ({} steps from {} to {} found)",
                                   text_, subject, step, existing.size(), existing.front(),
                                   existing.back()));
    chosen.push_back(step);
    if (last_ - step < stride_) return chosen;
  }
}

std::vector<std::size_t> StepChoice::among(std::size_t count, const std::string& subject) const {
  std::vector<std::size_t> existing(count);
  std::iota(existing.begin(), existing.end(), std::size_t{0});
  return among(existing, subject);
}

}  // namespace hiac::tools
