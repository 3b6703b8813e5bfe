#pragma once

#include <algorithm>
#include <limits>

#include "hiac/element/field_along_ray.hpp"
#include "hiac/frame/projection.hpp"
#include "hiac/render/cells/cell_scan.hpp"

namespace hiac {

/// The crossing of a cell with planar faces by the ray through a pixel centre, given only the
/// clipped segment: where the view clips the segment, the crossing extends beyond the view.
inline CellCrossing planar_crossing(const Projector& projector, int x, int y, double front,
                                    double back) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  CellCrossing crossing{};
  crossing.x = x;
  crossing.y = y;
  crossing.front = front == projector.near() ? -kFar : front;
  crossing.back = back == projector.far() ? kFar : back;
  crossing.front_reference = crossing.back_reference = {kNone, kNone, kNone};
  crossing.front_doubt = crossing.back_doubt = kNone;
  return crossing;
}

/// The part of the ray between the ends of a crossing that z-clipping leaves.
inline RayStretch stretch_of(const Projector& projector, const CellCrossing& crossing) {
  const double x = pixel_center(crossing.x), y = pixel_center(crossing.y);
  return {projector.relative_origin(x, y), projector.direction(x, y),
          std::max(crossing.front, projector.near()), std::min(crossing.back, projector.far()),
          place_of(crossing)};
}

}  // namespace hiac
