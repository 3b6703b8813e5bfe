#include "hiac/annotate/scalar_axis.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac {

ScalarAxis::ScalarAxis(double low, double high, bool logarithmic)
    : low_(low), high_(high), logarithmic_(logarithmic) {
  constexpr double kNarrowest = 1e-12, kSmallest = 1e-290;
  const double size = std::max(std::fabs(low), std::fabs(high));
  if (high / 2 - low / 2 > std::max(kNarrowest * size, kSmallest)) return;
  const double by = size <= kSmallest && !logarithmic ? 1 : size / 2;
  low_ -= by;
  high_ += by;
}

double ScalarAxis::value_at(double t) const {
  if (!logarithmic_) return (1 - t) * low_ + t * high_;
  return std::clamp(std::exp((1 - t) * std::log(low_) + t * std::log(high_)), low_, high_);
}

double ScalarAxis::position_of(double value) const {
  if (logarithmic_) return (std::log(value) - std::log(low_)) / (std::log(high_) - std::log(low_));
  // halves, because the range may be wider than a number can be
  return (value / 2 - low_ / 2) / (high_ / 2 - low_ / 2);
}

std::vector<Tick> ScalarAxis::ticks(
    const std::function<bool(const std::vector<Tick>&)>& fit) const {
  constexpr int kMost = 7;
  for (int count = kMost;; --count) {
    std::vector<Tick> ticks =
        logarithmic_ ? logarithmic_ticks(low_, high_, count) : round_ticks(low_, high_, count);
    if (count == 2 || fit(ticks)) return ticks;
  }
}

ScalarAxis axis_over(const std::array<double, 2>& range, bool logarithmic, const std::string& key) {
  if (logarithmic && !(range[0] > 0))
    throw InputError(fmt::format("key `{}`", key),
                     fmt::format("a logarithmic bar needs positive scalars (found {} to {})",
                                 range[0], range[1]));
  return {range[0], range[1], logarithmic};
}

}  // namespace hiac
