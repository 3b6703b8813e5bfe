#include "hiac/render/runs/run_folder.hpp"

#include <algorithm>
#include <utility>

#include "hiac/render/pixels/compositor.hpp"

namespace hiac {
RunFolder::RunFolder(TileBuffer& buffer, double witness_tolerance, bool with_details, bool apart)
    : buffer_(buffer),
      witness_tolerance_(witness_tolerance),
      apart_(apart),
      details_(with_details ? kTilePlane : 0),
      front_edge_(details_.size()) {
  open_.reset();
}

void RunFolder::begin(const ListedSegment& segment, const SegmentDetails* details) {
  const std::size_t at = segment.pixel;
  if (details != nullptr && open_.is_open(at)) closed_facts_.push_back(facts(at));
  open_.open(at, segment.front, buffer_);
  const bool is_late =
      out_of_order(segment.front, segment.back, buffer_.last[at], witness_tolerance_);
  if (is_late) ++violations_;
  if (details == nullptr) return;
  details_[at] = {};
  // whether empty space lies in front is not known here: it is counted where runs are merged
  details_[at].last = details->front;
  details_[at].violations = is_late ? 1 : 0;
  front_edge_[at] = details->front_edge;
}

void RunFolder::describe(std::size_t at, const SegmentDetails& details) {
  details_[at].add(details, open_.transparency[at],
                   std::max({open_.red[at], open_.green[at], open_.blue[at]}));
}

RunFacts RunFolder::facts(std::size_t at) const {
  const PixelDetails& d = details_[at];
  return {.first = d.first,
          .mean = d.weight > 0 ? d.weighted_depth / d.weight : open_.front[at],
          .radiance_error = d.radiance_error,
          .transparency_error = d.transparency_error,
          .front_edge = front_edge_[at],
          .back_edge = d.open_edge,
          .cells = d.cells,
          .violations = d.violations};
}

TileRuns RunFolder::take(TileCounts counts) {
  // counting sort of the closed runs, each pixel's open one behind them
  std::vector<std::uint32_t> next(kTilePlane + 1, 0);
  for (const RayRun& run : open_.closed) ++next[run.pixel + 1];
  for (std::size_t at = 0; at < kTilePlane; ++at)
    next[at + 1] += next[at] + (open_.is_open(at) ? 1 : 0);
  TileRuns all;
  all.runs.resize(next.back());
  all.facts.resize(details_.empty() ? 0 : next.back());
  for (std::size_t k = 0; k < open_.closed.size(); ++k) {
    const std::uint32_t to = next[open_.closed[k].pixel]++;
    all.runs[to] = open_.closed[k];
    if (!details_.empty()) all.facts[to] = closed_facts_[k];
  }
  for (std::size_t at = 0; at < kTilePlane; ++at) {
    if (!open_.is_open(at)) continue;
    all.runs[next[at]] = open_.run(at);
    if (!details_.empty()) all.facts[next[at]] = facts(at);
  }
  all.counts = counts;
  all.counts.violations += violations_;
  return all;
}

}  // namespace hiac
