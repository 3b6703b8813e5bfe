#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "hiac/render/pixels/tile.hpp"
#include "hiac/render/runs/ray_runs.hpp"

namespace hiac {

/// Makes runs of the segments of a tile's pixels, which come front to back in every pixel.
class RunFolder {
 public:
  /// `buffer`: of it the folder keeps the transparency of all of a pixel's segments together, by
  /// which kernels know what is not seen, and where they end. `apart`: every segment is a run of
  /// its own; for pixels in which something without extent, a splat, may lie between any two
  /// segments. The buffer must outlive it.
  RunFolder(TileBuffer& buffer, double witness_tolerance, bool with_details, bool apart);

  /// `details`: null where none are requested.
  void add(const ListedSegment& segment, const SegmentDetails* details) {
    const std::size_t at = segment.pixel;
    Open& run = open_[at];
    if (segment.front != run.back || apart_) begin(segment, details);
    if (details != nullptr) describe(at, *details);
    const auto& [rgb, transparency] = segment.light;
    for (std::size_t c = 0; c < 3; ++c) run.light.rgb[c] += run.light.transparency * rgb[c];
    run.light.transparency *= transparency;
    run.back = segment.back;
    buffer_.transparency[at] = run.before * run.light.transparency;
  }

  /// All runs, once all segments are there. `counts`: with those that came out of order.
  [[nodiscard]] TileRuns take(TileCounts counts);

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  // as large as a line of the cache
  struct alignas(64) Open {
    double front = kNone, back = -kNone;  // kNone: no run is open
    PlainRadiance light{{0, 0, 0}, 1};
    double before = 1;  // the transparency of the pixel's runs before
  };
  void begin(const ListedSegment& segment, const SegmentDetails* details);
  void describe(std::size_t at, const SegmentDetails& details);
  void close(std::size_t at);

  TileBuffer& buffer_;
  double witness_tolerance_;
  bool apart_;
  std::vector<Open> open_;             // by pixel
  std::vector<PixelDetails> details_;  // of the open runs; empty where none are requested
  std::vector<double> front_edge_;     // likewise
  std::uint64_t violations_ = 0;
  TileRuns closed_;  // as they came
};

}  // namespace hiac
