#include "tools/render/ticks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace hiac::tools {
namespace {

/// mantissa times ten to the exponent, as near as a double gets.
double decimal(int mantissa, int exponent) {
  return std::strtod(fmt::format("{}e{}", mantissa, exponent).c_str(), nullptr);
}

/// A step of 1, 2 or 5 times a power of ten.
struct Step {
  int mantissa;
  int exponent;

  [[nodiscard]] double value() const { return decimal(mantissa, exponent); }
  [[nodiscard]] Step next() const {
    if (mantissa == 5) return {1, exponent + 1};
    return {mantissa == 1 ? 2 : 5, exponent};
  }
};

/// Multiples of the step lie in a range that is rounded outwards by a little of it: so that 0.3 is
/// a multiple of 0.1 although neither is a double.
constexpr double kSlack = 1e-9;

double first_multiple(double low, double step) { return std::ceil(low / step - kSlack); }
double last_multiple(double high, double step) { return std::floor(high / step + kSlack); }

std::string label_of(double value, const Step& step, double largest) {
  const bool plain = largest < 1e6 && step.exponent > -6;
  if (plain) return fmt::format("{:.{}f}", value, std::max(0, -step.exponent));
  const int digits = static_cast<int>(std::floor(std::log10(largest))) - step.exponent;
  return value == 0 ? "0" : fmt::format("{:.{}e}", value, std::clamp(digits, 0, 16));
}

}  // namespace

std::vector<Tick> round_ticks(double low, double high, int count) {
  Step step{1, static_cast<int>(std::floor(std::log10(high / count - low / count)))};
  while (last_multiple(high, step.value()) - first_multiple(low, step.value()) + 1 > count)
    step = step.next();
  const double largest = std::max(std::fabs(low), std::fabs(high));
  std::vector<Tick> ticks;
  const double first = first_multiple(low, step.value());
  const auto more = static_cast<int>(last_multiple(high, step.value()) - first);
  for (int i = 0; i <= more; ++i) {
    const double multiple = first + i;
    const double value = std::clamp(multiple * step.value(), low, high);
    ticks.push_back({value, label_of(multiple == 0 ? 0 : value, step, largest)});
  }
  return ticks;
}

double round_below(double value) {
  Step step{1, static_cast<int>(std::floor(std::log10(value))) - 1};
  while (step.next().value() <= value) step = step.next();
  return step.value();
}

}  // namespace hiac::tools
