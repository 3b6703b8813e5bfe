#include "tools/view/transfer/curve_axes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hiac/session/starter/starter_camera.hpp"

namespace hiac::view {
namespace {

constexpr int kLeastDecades = 5, kMostDecades = 12;
// the ratio of any two of them is finite, with the margins beside them
constexpr double kLeastShown = 1e-140, kMostShown = 1e140;
constexpr double kLeftOfPlot = 1e4;  // pixels: farther than a mouse reaches

/// The power of ten at or below a positive number.
int decade(double value) { return static_cast<int>(std::floor(std::log10(value))); }

}  // namespace

double CurveAxes::x_of(double value) const {
  if (scale_ == TransferScale::log) {
    if (!(value > 0)) return box_.left - kLeftOfPlot;
    const double from = std::log(values_[0]), to = std::log(values_[1]);
    return std::lerp(box_.left, box_.right, (std::log(value) - from) / (to - from));
  }
  const double share = (value / 2 - values_[0] / 2) / (values_[1] / 2 - values_[0] / 2);
  return box_.left + share * (box_.right - box_.left);
}

double CurveAxes::value_along(double share) const {
  if (scale_ == TransferScale::log)
    return std::exp((1 - share) * std::log(values_[0]) + share * std::log(values_[1]));
  return (1 - share) * values_[0] + share * values_[1];
}

double CurveAxes::value_at(double x) const {
  const double pixels = std::max(box_.right - box_.left, 1.0);
  const double value = value_along((x - box_.left) / (box_.right - box_.left));
  const double step = scale_ == TransferScale::log
                          ? value * std::expm1(std::log(values_[1] / values_[0]) / pixels)
                          : (values_[1] - values_[0]) / pixels;
  // a multiple of a power of ten that is at most a tenth of a pixel
  return starter::rounded(value, 100 * step);
}

double CurveAxes::y_of(double extinction) const {
  if (!(extinction > 0)) return box_.bottom;
  const double from = std::log10(extinctions_[0]), to = std::log10(extinctions_[1]);
  const double share = std::clamp((std::log10(extinction) - from) / (to - from), 0.0, 1.0);
  return zero_line() - share * (zero_line() - box_.top);
}

double CurveAxes::extinction_at(double y) const {
  if (y > zero_line()) return 0;
  const double from = std::log10(extinctions_[0]), to = std::log10(extinctions_[1]);
  const double share = std::clamp((zero_line() - y) / (zero_line() - box_.top), 0.0, 1.0);
  const double value = std::pow(10, from + share * (to - from));
  return starter::rounded(value, value);
}

std::array<double, 2> CurveAxes::zoomed(double x, double factor) const {
  const double share = (x - box_.left) / (box_.right - box_.left);
  const std::array<double, 2> wanted{value_along(share - factor * share),
                                     value_along(share + factor * (1 - share))};
  // doubles tell a thousand pixels apart
  const double least = 1e-10 * std::max(std::abs(wanted[0]), std::abs(wanted[1]));
  const bool is_drawn = scale_ == TransferScale::linear || wanted[0] > 0;
  return wanted[1] - wanted[0] > least && std::isfinite(wanted[1] - wanted[0]) && is_drawn
             ? wanted
             : values_;
}

std::array<double, 2> extinction_range(std::span<const ExtinctionTransfer::Point> points) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const auto& point : points) {
    if (!(point.value[0] > 0) || !std::isfinite(point.value[0])) continue;
    least = std::min(least, point.value[0]);
    most = std::max(most, point.value[0]);
  }
  if (most == 0) return {1e-3, 1e2};
  const int to = std::min(decade(most) + 2, 308);
  const int from = std::clamp(decade(least), to - kMostDecades, to - kLeastDecades);
  return {std::pow(10, std::max(from, -307)), std::pow(10, std::max(to, -302))};
}

std::array<double, 2> shown_values(const std::array<double, 2>& extent) {
  const double width = extent[1] / 2 - extent[0] / 2;
  const double size = std::max(std::abs(extent[0]), std::abs(extent[1]));
  const double margin = width > 1e-9 * size ? 0.04 * width : (size > 0 ? 0.5 * size : 1.0);
  return {extent[0] - margin, extent[1] + margin};
}

std::optional<std::array<double, 2>> shown_log_values(const std::array<double, 2>& extent) {
  if (!(extent[1] > 0)) return std::nullopt;
  const double high = std::clamp(extent[1], kLeastShown, kMostShown);
  const double low =
      extent[0] > 0 ? std::clamp(extent[0], kLeastShown, high) : high * std::pow(10, -kLogDecades);
  const double margin = low < high ? std::pow(high / low, 0.02) : std::sqrt(10);
  return std::array<double, 2>{low / margin, high * margin};
}

std::array<double, 2> with_nearby(std::array<double, 2> extent, std::span<const double> scalars) {
  const double reach = (extent[1] - extent[0]) / 2;
  const std::array<double, 2> least{extent[0] - reach, extent[1] + reach};
  for (const double scalar : scalars) {
    if (!(scalar >= least[0] && scalar <= least[1])) continue;
    extent[0] = std::min(extent[0], scalar);
    extent[1] = std::max(extent[1], scalar);
  }
  return extent;
}

std::optional<std::size_t> nearest(std::span<const Place> items, const Place& place, double reach) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const double distance = std::hypot(items[i].x - place.x, items[i].y - place.y);
    if (distance > reach) continue;
    reach = distance;
    found = i;
  }
  return found;
}

std::optional<double> half_value_length(double extinction) {
  if (!(extinction > 0)) return std::nullopt;
  return std::numbers::ln2 / extinction;
}

}  // namespace hiac::view
