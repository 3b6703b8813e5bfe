#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "hiac/optics/piece_rule.hpp"
#include "hiac/render/bounds/error_bound.hpp"
#include "hiac/render/pixels/pixel_details.hpp"

namespace hiac {

/// The difference between two computations of the same light.
inline ErrorBound apart(const std::array<double, 3>& a, double transparency_a,
                        const std::array<double, 3>& b, double transparency_b) {
  ErrorBound bound;
  for (std::size_t c = 0; c < 3; ++c)
    bound.radiance = std::max(bound.radiance, std::abs(a[c] - b[c]));
  bound.transparency = std::abs(transparency_a - transparency_b);
  return bound;
}

/// Collects the details of a segment that is integrated part by part, front to back.
class SegmentNotes {
 public:
  void begin(double front, double back) {
    details_ = {.front = front, .back = back, .first = front};
    weight_ = weighted_depth_ = 0;
  }

  /// Adds the bound of a part's quadrature. `visible` is the segment's transparency in front of the
  /// part.
  void add_quadrature(double visible, const ErrorBound& bound, const PlainRadiance& part) {
    details_.radiance_error +=
        visible * bound.radiance + details_.transparency_error * std::ranges::max(part.rgb);
    details_.transparency_error += visible * bound.transparency;
  }
  /// Adds the difference between a part's light integrated together with others, which has no error
  /// bound, and its light integrated alone.
  void add_apart(double visible, const PlainRadiance& together, const PlainRadiance& alone) {
    const ErrorBound bound =
        apart(together.rgb, together.transparency, alone.rgb, alone.transparency);
    details_.radiance_error += visible * bound.radiance;
    details_.transparency_error += visible * bound.transparency;
  }
  /// Adds opacity of the segment at the ray parameter t, for the mean depth.
  void add_depth(double t, double opacity) {
    weight_ += opacity;
    weighted_depth_ += opacity * t;
  }

  /// The details of the whole segment, except those that only its cell knows.
  [[nodiscard]] SegmentDetails finish(const PlainRadiance& radiance) {
    details_.light = std::ranges::max(radiance.rgb);
    details_.transparency = radiance.transparency;
    details_.mean =
        weight_ > 0 ? weighted_depth_ / weight_ : 0.5 * (details_.front + details_.back);
    return details_;
  }

 private:
  SegmentDetails details_;
  double weight_ = 0, weighted_depth_ = 0;
};

}  // namespace hiac
