#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace hiac::tools {

/// How --help describes the value of --steps.
inline constexpr const char* kStepsType = "all|FIRST:LAST[:STRIDE]";

/// The steps that --steps asks for.
class StepChoice {
 public:
  /// "all", or FIRST:LAST[:STRIDE]: FIRST, FIRST + STRIDE and so on up to LAST, which is included
  /// if it is reached. Throws UsageError.
  explicit StepChoice(const std::string& text);

  /// The chosen ones of the steps that there are, ascending. Throws UsageError, which names
  /// `subject`, for one that there is not. `existing`: ascending, not empty.
  [[nodiscard]] std::vector<std::size_t> among(std::span<const std::size_t> existing,
                                               const std::string& subject) const;

  /// The same of the steps 0 to count - 1.
  [[nodiscard]] std::vector<std::size_t> among(std::size_t count, const std::string& subject) const;

 private:
  std::string text_;
  bool all_ = false;
  std::size_t first_ = 0, last_ = 0, stride_ = 1;
};

}  // namespace hiac::tools
