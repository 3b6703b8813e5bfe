#include "hiac/render/runs/run_folder.hpp"

#include <algorithm>
#include <utility>

#include "hiac/render/pixels/compositor.hpp"

namespace hiac {
namespace {

constexpr std::size_t kPixels = kTileStride * kTileHeight;

// Runs, and their facts, by pixel, otherwise in their order.
void sort_by_pixel(TileRuns& all) {
  std::vector<std::uint32_t> next(kPixels + 1, 0);
  for (const RayRun& run : all.runs) ++next[run.pixel + 1];
  for (std::size_t p = 1; p < next.size(); ++p) next[p] += next[p - 1];
  TileRuns sorted;
  sorted.runs.resize(all.runs.size());
  sorted.facts.resize(all.facts.size());
  for (std::size_t k = 0; k < all.runs.size(); ++k) {
    const std::uint32_t to = next[all.runs[k].pixel]++;
    sorted.runs[to] = all.runs[k];
    if (!all.facts.empty()) sorted.facts[to] = all.facts[k];
  }
  all = std::move(sorted);
}

}  // namespace

RunFolder::RunFolder(TileBuffer& buffer, double witness_tolerance, bool with_details, bool apart)
    : buffer_(buffer),
      witness_tolerance_(witness_tolerance),
      apart_(apart),
      open_(kPixels),
      details_(with_details ? kPixels : 0),
      front_edge_(details_.size()) {}

void RunFolder::begin(const ListedSegment& segment, const SegmentDetails* details) {
  const std::size_t at = segment.pixel;
  Open& run = open_[at];
  if (run.front != kNone) close(at);
  const bool is_late =
      out_of_order(segment.front, segment.back, buffer_.last[at], witness_tolerance_);
  if (is_late) ++violations_;
  run.front = run.back = segment.front;
  if (details == nullptr) return;
  details_[at] = {};
  // whether empty space lies in front is not known here: it is counted where runs are merged
  details_[at].last = details->front;
  details_[at].violations = is_late ? 1 : 0;
  front_edge_[at] = details->front_edge;
}

void RunFolder::describe(std::size_t at, const SegmentDetails& details) {
  const PlainRadiance& light = open_[at].light;
  details_[at].add(details, light.transparency,
                   std::max({light.rgb[0], light.rgb[1], light.rgb[2]}));
}

void RunFolder::close(std::size_t at) {
  Open& run = open_[at];
  buffer_.last[at] = std::max(buffer_.last[at], run.back);
  closed_.runs.push_back({run.front, run.back, run.light, static_cast<std::uint32_t>(at)});
  if (!details_.empty()) {
    const PixelDetails& d = details_[at];
    closed_.facts.push_back({.first = d.first,
                             .mean = d.weight > 0 ? d.weighted_depth / d.weight : run.front,
                             .radiance_error = d.radiance_error,
                             .transparency_error = d.transparency_error,
                             .front_edge = front_edge_[at],
                             .back_edge = d.open_edge,
                             .cells = d.cells,
                             .violations = d.violations});
  }
  const double before = run.before * run.light.transparency;
  run = {};
  run.before = before;
}

TileRuns RunFolder::take(TileCounts counts) {
  for (std::size_t at = 0; at < kPixels; ++at)
    if (open_[at].front != kNone) close(at);
  sort_by_pixel(closed_);
  counts.violations += violations_;
  closed_.counts = counts;
  return std::move(closed_);
}

}  // namespace hiac
