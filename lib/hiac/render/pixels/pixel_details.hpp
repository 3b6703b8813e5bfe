#pragma once

#include <cstdint>
#include <limits>

#include "hiac/frame/tiles/drawn_tile.hpp"

namespace hiac {

/// What a ray passes or meets.
enum class RayPart : std::uint8_t { inside, skin, edge };

/// The details of a ray segment for further channels. Depths are ray parameters.
struct SegmentDetails {
  double front = 0, back = 0;
  double light = 0;         ///< largest channel of the segment's light
  double transparency = 1;  ///< of the segment
  double first = 0;         ///< where it begins to emit or absorb
  double mean = 0;          ///< depth of its opacity
  RayPart part = RayPart::inside;
  double radiance_error = 0, transparency_error = 0;  ///< ErrorBound
  double front_edge = 0, back_edge = 0;  ///< additional errors where no cell adjoins (edge_bound)
  double moved = 0;     ///< of the skin: how far its place may be off, a ray parameter
  double in_doubt = 0;  ///< of the skin: its radiance_error if its place among others is in doubt
};

/// Facts about a pixel besides its colour, accumulated segment by segment, front to back.
struct PixelDetails : PixelFacts {
  double radiance_error = 0, transparency_error = 0;
  double last = -std::numeric_limits<double>::infinity();  ///< where the last segment ended
  std::uint32_t met = 0;  ///< how often the ray met the skin or an edge, or may have
  double open_edge = 0;   ///< its back_edge, times what is visible
  bool parted = false;    ///< the ray met the skin since

  /// Adds a segment to all members except violations. `visible`: the transparency in front;
  /// `light`: the pixel's largest channel so far.
  void add(const SegmentDetails& segment, double visible, double light);
  /// Adds the bounds of something that may be missing behind what is so far.
  void add_missing(double radiance, double opacity, double visible);
};

}  // namespace hiac
