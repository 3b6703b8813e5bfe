#pragma once

#include <cstdint>
#include <vector>

#include "hiac/render/pixels/tile.hpp"
#include "hiac/render/runs/ray_runs.hpp"

namespace hiac {

/// Makes runs of the segments of a tile's pixels, which come front to back in every pixel.
class RunFolder {
 public:
  /// `apart`: every segment is a run of its own; for pixels in which something without extent, a
  /// splat, may lie between any two segments.
  RunFolder(bool with_details, bool apart);

  /// `details`: null where none are requested. `is_late`: it was met out of order.
  void add(const ListedSegment& segment, const SegmentDetails* details, bool is_late);

  /// All runs, once all segments are there.
  [[nodiscard]] TileRuns take(const TileCounts& counts);

 private:
  struct Open {
    double front, back;
    PlainRadiance light;
  };
  void close(std::size_t pixel);

  bool with_details_, apart_;
  std::vector<Open> open_;  // by pixel
  std::vector<std::uint8_t> is_open_;
  std::vector<PixelDetails> details_;  // of the open runs; empty where none are requested
  std::vector<double> front_edge_;     // likewise
  TileRuns closed_;                    // as they came
};

}  // namespace hiac
