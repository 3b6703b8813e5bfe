#pragma once

#include <algorithm>
#include <cstddef>

#include "hiac/optics/piece_rule.hpp"
#include "hiac/render/pixels/open_runs.hpp"
#include "hiac/render/pixels/tile.hpp"

namespace hiac {

// Composites segments: here one by one, in compositor-inl.hpp in vectors of neighbouring pixels,
// and in refine/ in extended precision, which no tile stores. All versions add the light times the
// transparency in front of it, and count segments out of order in the same way.
//
// The kernels of tetrahedra fuse product and sum, which rounds once. Cells of all kinds do not:
// their segments come in vectors or one by one, as it happens, and make the same pixels either way
// on every machine.

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

/// Adds a segment, before it is composited, to a pixel's details.
inline void describe(std::size_t at, const SegmentDetails& segment, double tolerance,
                     TileBuffer& buffer) {
  PixelDetails& pixel = buffer.details[at];
  if (out_of_order(segment.front, segment.back, buffer.last[at], tolerance)) ++pixel.violations;
  const double light = std::max({buffer.red[at], buffer.green[at], buffer.blue[at]});
  pixel.add(segment, buffer.transparency[at], light);
}

/// Adds a segment to the runs of a part of a mesh. open_runs-inl.hpp does the same of vectors.
inline void add_to_runs(std::size_t at, double front, double back, const PlainRadiance& radiance,
                        double tolerance, OpenRuns& runs, TileBuffer& buffer, TileCounts& counts) {
  if (front != runs.back[at]) {
    runs.open(at, front, buffer);
    if (out_of_order(front, back, buffer.last[at], tolerance)) ++counts.violations;
  }
  runs.extend(at, back, radiance, buffer);
}

/// The same where cells are drawn: in a group, segments and their details join its list.
inline void composite(const TileTarget& to, std::size_t at, double front, double back,
                      const PlainRadiance& radiance) {
  if (to.group != nullptr) return to.group->segments.push_back({at, front, back, radiance});
  if (to.runs != nullptr)
    return add_to_runs(at, front, back, radiance, to.frame.witness_tolerance, *to.runs, to.buffer,
                       to.counts);
  composite(at, front, back, radiance, to.frame.witness_tolerance, to.buffer, to.counts);
}
inline void describe(const TileTarget& to, std::size_t at, const SegmentDetails& segment) {
  if (to.group != nullptr) return to.group->details.push_back(segment);
  describe(at, segment, to.frame.witness_tolerance, to.buffer);
}

}  // namespace hiac
