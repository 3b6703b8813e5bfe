#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "hiac/render/edges/strip_coverage.hpp"

namespace hiac::test {

/// A strip as its samples ask for it: how far along it and aside from its line a point is.
class SampledStrip {
 public:
  explicit SampledStrip(const Strip& s)
      : x0_(s.x0),
        y0_(s.y0),
        length_(std::hypot(s.x1 - s.x0, s.y1 - s.y0)),
        right_((s.x1 - s.x0) / length_),
        down_((s.y1 - s.y0) / length_),
        half_(s.width / 2) {}

  /// Whether the strip, made longer and wider by a margin on all sides, holds a point.
  [[nodiscard]] bool holds(double x, double y, double margin = 0) const {
    const double along = (x - x0_) * right_ + (y - y0_) * down_;
    const double aside = (x - x0_) * down_ - (y - y0_) * right_;
    return along >= -margin && along <= length_ + margin && std::abs(aside) <= half_ + margin;
  }

 private:
  double x0_, y0_, length_, right_, down_, half_;
};

/// The strips that may reach the pixel around (x, y).
inline std::vector<SampledStrip> strips_near(const std::vector<Strip>& strips, double x, double y) {
  std::vector<SampledStrip> near;
  for (const Strip& strip : strips)
    if (const SampledStrip sampled(strip); sampled.holds(x, y, 1)) near.push_back(sampled);
  return near;
}

/// The mean of value(x, y) over 64 x 64 samples of the pixel around (x, y).
template <typename Value>
double sampled_mean(double x, double y, const Value& value) {
  constexpr int kSamples = 64;
  double sum = 0;
  for (int i = 0; i < kSamples; ++i)
    for (int j = 0; j < kSamples; ++j)
      sum += value(x + (i + 0.5) / kSamples - 0.5, y + (j + 0.5) / kSamples - 0.5);
  return sum / (kSamples * kSamples);
}

inline bool any_holds(const std::vector<SampledStrip>& strips, double x, double y) {
  return std::ranges::any_of(strips, [&](const SampledStrip& s) { return s.holds(x, y); });
}

/// The share of 64 x 64 samples of a pixel that lie in any of the strips.
inline double sampled_coverage(const std::vector<Strip>& strips, double x, double y) {
  const auto near = strips_near(strips, x, y);
  if (near.empty()) return 0;
  return sampled_mean(x, y, [&](double px, double py) { return any_holds(near, px, py) ? 1 : 0; });
}

}  // namespace hiac::test
