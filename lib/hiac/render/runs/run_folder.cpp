#include "hiac/render/runs/run_folder.hpp"

#include <algorithm>
#include <limits>
#include <utility>

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

RunFolder::RunFolder(bool with_details, bool apart)
    : with_details_(with_details),
      apart_(apart),
      open_(kPixels),
      is_open_(kPixels, 0),
      details_(with_details ? kPixels : 0),
      front_edge_(details_.size()) {}

void RunFolder::add(const ListedSegment& segment, const SegmentDetails* details, bool is_late) {
  const std::size_t at = segment.pixel;
  Open& run = open_[at];
  if (is_open_[at] != 0 && (apart_ || segment.front != run.back)) close(at);
  if (is_open_[at] == 0) {
    is_open_[at] = 1;
    run = {segment.front, segment.back, {{0, 0, 0}, 1}};
    if (with_details_) {
      details_[at] = {};
      // whether empty space lies in front is not known here: it is counted where runs are merged
      details_[at].last = details->front;
      front_edge_[at] = details->front_edge;
    }
  }
  PlainRadiance& light = run.light;
  if (with_details_) {
    details_[at].add(*details, light.transparency,
                     std::max({light.rgb[0], light.rgb[1], light.rgb[2]}));
    if (is_late) ++details_[at].violations;
  }
  for (std::size_t c = 0; c < 3; ++c) light.rgb[c] += light.transparency * segment.light.rgb[c];
  light.transparency *= segment.light.transparency;
  run.back = segment.back;
}

void RunFolder::close(std::size_t pixel) {
  const Open& run = open_[pixel];
  is_open_[pixel] = 0;
  closed_.runs.push_back({run.front, run.back, run.light, static_cast<std::uint32_t>(pixel)});
  if (!with_details_) return;
  const PixelDetails& d = details_[pixel];
  closed_.facts.push_back({.first = d.first,
                           .mean = d.weight > 0 ? d.weighted_depth / d.weight : run.front,
                           .radiance_error = d.radiance_error,
                           .transparency_error = d.transparency_error,
                           .front_edge = front_edge_[pixel],
                           .back_edge = d.open_edge,
                           .cells = d.cells,
                           .violations = d.violations});
}

TileRuns RunFolder::take(const TileCounts& counts) {
  for (std::size_t pixel = 0; pixel < kPixels; ++pixel)
    if (is_open_[pixel] != 0) close(pixel);
  sort_by_pixel(closed_);
  closed_.counts = counts;
  return std::move(closed_);
}

}  // namespace hiac
