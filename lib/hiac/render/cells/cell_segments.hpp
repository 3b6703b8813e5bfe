#pragma once

#include <cstdint>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/pixels/tile.hpp"

namespace hiac {

/// Segments of rays in one cell: structure of arrays, each with `count` entries and padding.
struct CellSegments {
  static constexpr std::size_t kPadding = 7;  ///< most lanes of a vector behind the last segment

  std::size_t count = 0;
  std::vector<std::uint32_t> at;                  ///< pixels: indices into the tile's planes
  std::vector<double> x, y;                       ///< coordinates of pixel centres
  std::vector<double> front, back;                ///< ray parameters
  bool known = false;                             ///< whether known_u, known_v, known_w are used
  std::vector<double> known_u, known_v, known_w;  ///< collapsed coordinates near the front
  std::vector<double> length;                     ///< world units
  std::vector<double> allowed;                    ///< absolute error of colours and transparency
  std::vector<double> red, green, blue, transparency;  ///< results
  std::vector<std::uint8_t> done;                      ///< whether the results are valid

  /// Empties the arrays and reserves space for `most` segments and their padding.
  void start(std::size_t most, bool with_known);
  /// Fills the padding with copies of the last segment, of length 0. There must be at least one
  /// segment.
  void pad();
};

/// Appends those segments of runs (scan_projected_runs) that are visible and have a length above 0
/// between the view's clipping planes. `allowed`: the error of a unit of the ray parameter; it is
/// divided by the transparency in front of the segment, except in groups.
void collect_runs(const TileTarget& to, const CrossingRuns& runs, double allowed,
                  CellSegments& segments);

/// Composites those of the first `count` segments that are done; no two of them may belong to one
/// pixel. Returns how many of them begin before the previous segment of their pixel ends by more
/// than the frame's tolerance, and are longer than that tolerance.
std::uint64_t composite_segments(const Frame& frame, const CellSegments& segments,
                                 std::size_t count, TileBuffer& buffer);

}  // namespace hiac
