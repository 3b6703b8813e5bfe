#pragma once

#include <algorithm>
#include <cstddef>

#include "hiac/optics/piece_rule.hpp"
#include "hiac/render/pixels/tile.hpp"

namespace hiac {

/// Whether a segment from `front` to `back` begins before what lies in front of it had ended, at
/// `last`, by more than the tolerance (all ray parameters). A segment shorter than the tolerance
/// may be rounding, and lie anywhere. compositor-inl.hpp says the same of vectors.
inline bool out_of_order(double front, double back, double last, double tolerance) {
  return front < last - tolerance && back - front > tolerance;
}

/// Composites a segment behind all that a pixel of the buffer holds.
inline void composite(std::size_t at, double front, double back, const PlainRadiance& radiance,
                      double tolerance, TileBuffer& buffer, TileCounts& counts) {
  double& last = buffer.last[at];
  if (out_of_order(front, back, last, tolerance)) ++counts.violations;
  last = std::max(last, back);
  double& transparency = buffer.transparency[at];
  buffer.red[at] += transparency * radiance.rgb[0];
  buffer.green[at] += transparency * radiance.rgb[1];
  buffer.blue[at] += transparency * radiance.rgb[2];
  transparency *= radiance.transparency;
}

}  // namespace hiac
