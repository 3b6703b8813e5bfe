#pragma once

#include <cstdint>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/pixels/tile.hpp"

namespace hiac {

/// Segments of rays in one cell: structure of arrays, of `count` and more places.
struct CellSegments {
  static constexpr std::size_t kPadding = 7;  ///< most places of a vector behind the last one

  std::size_t count = 0;
  std::vector<std::uint32_t> at;                  ///< pixels: indices into the tile's planes
  std::vector<double> x, y;                       ///< of pixels' centres
  std::vector<double> front, back;                ///< ray parameters
  bool known = false;                             ///< whether there are known_u, known_v, known_w
  std::vector<double> known_u, known_v, known_w;  ///< collapsed coordinates near the front
  std::vector<double> length;                     ///< world units
  std::vector<double> allowed;                    ///< absolute error of colours and transparency
  std::vector<double> red, green, blue, transparency;  ///< results
  std::vector<std::uint8_t> done;                      ///< whether there are results

  /// Makes place for `most` segments and their padding; there are none yet.
  void start(std::size_t most, bool with_known);
  /// Makes what a vector has behind the last segment that one again, without length. There must be
  /// one.
  void pad();
};

/// Appends the segments of runs (scan_projected_runs) that have depth between the view's clipping
/// planes, and are seen. `allowed`: error for a unit of the ray parameter, which grows as less is
/// seen of the segment, but for groups.
void collect_runs(const TileTarget& to, const CrossingRuns& runs, double allowed,
                  CellSegments& segments);

/// Composites those of the first `count` segments that are done; no two of them have one pixel.
/// Returns how many of them begin before the last one of their pixel had ended, both by more than
/// the frame's tolerance.
std::uint64_t composite_segments(const Frame& frame, const CellSegments& segments,
                                 std::size_t count, TileBuffer& buffer);

}  // namespace hiac
