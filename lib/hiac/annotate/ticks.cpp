#include "hiac/annotate/ticks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

#include <fmt/format.h>

namespace hiac {
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

namespace {

/// Whether a range that is rounded outwards by a little contains a value.
bool contains(double low, double high, double value) {
  return value >= low * (1 - kSlack) && value <= high * (1 + kSlack);
}

Tick logarithmic_tick(int mantissa, int exponent, double low, double high) {
  const double value = decimal(mantissa, exponent);
  // plain numbers while they are short
  const bool plain = exponent >= -4 && exponent <= 5;
  return {std::clamp(value, low, high), plain
                                            ? fmt::format("{:.{}f}", value, std::max(0, -exponent))
                                            : fmt::format("{}e{:+03d}", mantissa, exponent)};
}

/// Those of the mantissas times powers of ten that lie in the range; every `stride`th power.
std::vector<Tick> decade_ticks(double low, double high, std::span<const int> mantissas,
                               int stride) {
  std::vector<Tick> ticks;
  const int first = static_cast<int>(std::floor(std::log10(low))) - 1;
  const int last = static_cast<int>(std::ceil(std::log10(high))) + 1;
  for (int exponent = first; exponent <= last; ++exponent)
    for (const int mantissa : mantissas)
      if (exponent % stride == 0 && contains(low, high, decimal(mantissa, exponent)))
        ticks.push_back(logarithmic_tick(mantissa, exponent, low, high));
  return ticks;
}

}  // namespace

std::vector<Tick> logarithmic_ticks(double low, double high, int count) {
  constexpr int kPowers[] = {1}, kRound[] = {1, 2, 5};
  const auto most = static_cast<std::size_t>(count);
  for (int stride = 1;; ++stride) {
    std::vector<Tick> ticks = decade_ticks(low, high, kPowers, stride);
    if (ticks.size() < 2) break;
    if (ticks.size() <= most) return ticks;
  }
  std::vector<Tick> ticks = decade_ticks(low, high, kRound, 1);
  if (ticks.size() >= 2 && ticks.size() <= most) return ticks;
  return round_ticks(low, high, count);
}

std::string typeset(const std::string& number) {
  std::string text;
  for (const char c : number) text += c == '-' ? std::string("\u2212") : std::string(1, c);
  return text;
}

double round_below(double value) {
  Step step{1, static_cast<int>(std::floor(std::log10(value))) - 1};
  while (step.next().value() <= value) step = step.next();
  return step.value();
}

}  // namespace hiac
