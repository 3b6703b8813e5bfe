#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/frame/tiles/tile.hpp"
#include "hiac/optics/piece_rule.hpp"
#include "hiac/render/pixels/pixel_details.hpp"

namespace hiac {

/// The pixels of the current tile.
struct TileBuffer : TilePixels {
  Plane ray_scale;                    ///< world length per unit of ray parameter
  std::vector<PixelDetails> details;  ///< empty where no channel needs them

  /// Empties the buffer for a tile.
  void reset(const TileRect& tile, const Projector& projector, bool with_details);
};

/// A ray segment of a tile's pixel, and its radiance.
struct ListedSegment {
  std::size_t pixel;   ///< index into the tile's planes
  double front, back;  ///< ray parameters
  PlainRadiance light;
};

/// Ray segments whose order is not yet known: those of a group of cells in one tile.
struct SegmentList {
  std::vector<ListedSegment> segments;
  std::vector<SegmentDetails> details;  ///< of each; empty where no channel needs them

  void clear() {
    segments.clear();
    details.clear();
  }
  /// Puts another list before this one.
  void prepend(const SegmentList& other);
  /// The order of one pixel's segments: by depth.
  [[nodiscard]] bool nearer(std::uint32_t a, std::uint32_t b) const;
};

struct OpenRuns;

/// The details of segment sorted[i] of a list. `sorted`: segments of the list in the order in which
/// they are composited, those of a pixel together. Skins that are nearer to one another than both
/// are off may have been swapped: all of them is in doubt.
SegmentDetails details_in_order(const SegmentList& list, std::span<const std::uint32_t> sorted,
                                std::size_t i);

/// Where the cells of one tile are drawn: over its pixels, into the runs of a part of a mesh or, in
/// a group of cells whose order is yet to be found, into a list.
struct TileTarget {
  const Frame& frame;
  const TileRect& tile;
  TileBuffer& buffer;
  SegmentList* group;  ///< null where segments are composited
  TileCounts& counts;
  OpenRuns* runs = nullptr;  ///< where they are composited without details, if not over the pixels

  /// Whether anything behind a pixel's segments so far is visible.
  [[nodiscard]] bool is_seen(std::size_t at) const {
    return buffer.transparency[at] > frame.least_transparency;
  }
  /// The transparency in front of a segment; taken as 1 in a group.
  [[nodiscard]] double visible(std::size_t at) const {
    return group != nullptr ? 1 : buffer.transparency[at];
  }
};

/// Sorts the segments by pixel and depth and composites them: exact for any order of the list.
void composite_sorted(const SegmentList& list, double witness_tolerance, TileBuffer& buffer,
                      TileCounts& counts);

}  // namespace hiac
