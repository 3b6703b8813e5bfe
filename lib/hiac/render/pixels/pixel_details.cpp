#include "hiac/render/pixels/pixel_details.hpp"

#include <algorithm>

#include "hiac/base/rounding.hpp"

namespace hiac {

void PixelDetails::add(const SegmentDetails& segment, double visible, double light) {
  const bool inside = segment.part == RayPart::inside;
  ++(inside ? cells : met);
  if (segment.transparency < 1 || segment.light > 0) first = std::min(first, segment.first);
  const double opacity = visible * (1 - segment.transparency);
  weight += opacity;
  weighted_depth += opacity * segment.mean;

  if (inside && (segment.front != last || parted)) {
    // the ray came through empty space, or through a skin beside which volume is gained or lost
    const double edges = open_edge + (visible + transparency_error) * segment.front_edge;
    radiance_error += edges;
    transparency_error += edges;
  }
  const double most_visible = visible + transparency_error;
  radiance_error += most_visible * segment.radiance_error + transparency_error * segment.light +
                    4 * kUnit * (light + visible * segment.light);
  transparency_error = std::min(transparency_error * segment.transparency +
                                    most_visible * segment.transparency_error + 2 * kUnit * visible,
                                1.0);
  if (!inside) {  // has no volume in doubt, and lies on the cell before or behind
    radiance_error += open_edge * segment.light;
    parted = parted || segment.part == RayPart::skin;
    return;
  }
  parted = false;
  open_edge = most_visible * segment.back_edge;
  last = segment.back;
}

void PixelDetails::add_missing(double radiance, double opacity, double visible) {
  ++met;
  const double most_visible = visible + transparency_error;
  radiance_error += most_visible * radiance;
  transparency_error = std::min(transparency_error + most_visible * opacity, 1.0);
}

}  // namespace hiac
