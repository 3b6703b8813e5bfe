#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hiac/render/pixels/open_runs.hpp"
#include "hiac/render/pixels/tile.hpp"
#include "hiac/render/runs/ray_runs.hpp"

namespace hiac {

/// Makes runs of the segments of a tile's pixels, which come front to back in every pixel.
class RunFolder {
 public:
  /// `buffer`: of it the folder keeps what OpenRuns keeps. `apart`: every segment is a run of its
  /// own; for pixels in which something without extent, a splat, may lie between any two segments.
  /// The buffer must outlive it.
  RunFolder(TileBuffer& buffer, double witness_tolerance, bool with_details, bool apart);

  /// Where kernels may draw all but the segments that have to be added one by one: those of groups,
  /// and all where details are requested or segments are runs of their own.
  [[nodiscard]] OpenRuns& open() { return open_; }

  /// `details`: null where none are requested.
  void add(const ListedSegment& segment, const SegmentDetails* details) {
    const std::size_t at = segment.pixel;
    if (segment.front != open_.back[at] || apart_) begin(segment, details);
    if (details != nullptr) describe(at, *details);
    open_.extend(at, segment.back, segment.light, buffer_);
  }

  /// All runs, once all segments are there. `counts`: with those that came out of order.
  [[nodiscard]] TileRuns take(TileCounts counts);

 private:
  void begin(const ListedSegment& segment, const SegmentDetails* details);
  void describe(std::size_t at, const SegmentDetails& details);
  [[nodiscard]] RunFacts facts(std::size_t at) const;

  TileBuffer& buffer_;
  double witness_tolerance_;
  bool apart_;
  OpenRuns open_;
  std::vector<PixelDetails> details_;   // of the open runs; empty where none are requested
  std::vector<double> front_edge_;      // likewise
  std::vector<RunFacts> closed_facts_;  // of the closed runs
  std::uint64_t violations_ = 0;
};

}  // namespace hiac
