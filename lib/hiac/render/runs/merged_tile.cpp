#include "hiac/render/runs/merged_tile.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "hiac/render/bounds/pixel_error.hpp"
#include "hiac/render/pixels/compositor.hpp"
#include "hiac/render/runs/runs_by_depth.hpp"

namespace hiac {
namespace {}  // namespace

MergeConstants merge_constants(const Frame& frame) {
  return {frame.least_transparency, frame.witness_tolerance, frame.largest_light,
          frame.with_details};
}

MergedTile::MergedTile(const MergeConstants& constants, std::span<const TileRuns> parts,
                       const EdgedView* edges)
    : constants_(constants), details_(constants.with_details ? kTilePlane : 0) {
  pixels_.red.fill(0);
  pixels_.green.fill(0);
  pixels_.blue.fill(0);
  pixels_.transparency.fill(1);
  pixels_.last.fill(-std::numeric_limits<double>::infinity());
  for (const TileRuns& part : parts) {
    counts_ += part.counts;
    if (!part.covers.empty()) covers_.resize(kTilePlane, 1);
    for (const SkinCover& cover : part.covers) covers_[cover.pixel] *= cover.transparency;
  }
  for (const RunPlace& place : runs_by_depth(parts)) {
    const TileRuns& part = parts[place.part];
    composite(part.runs[place.run], part.facts.empty() ? nullptr : &part.facts[place.run]);
  }
  if (edges == nullptr) return;
  covers_.resize(kTilePlane, 1);
  std::vector<const EdgedTile*> edged;
  for (const TileRuns& part : parts) edged.push_back(&part.edged);
  visit_edged(edged, *edges, [&](const EdgedSegment& segment) { return composite(segment); });
}

void MergedTile::composite(const RayRun& run, const RunFacts* facts) {
  const std::size_t at = run.pixel;
  const double transparency = pixels_.transparency[at];
  if (transparency <= constants_.least_transparency) return;
  const bool is_late = note_place(at, run.front, run.back);
  const auto& [rgb, behind] = run.light;
  if (facts != nullptr) {
    SegmentDetails segment;
    segment.front = run.front;
    segment.back = run.back;
    segment.light = std::max({rgb[0], rgb[1], rgb[2]});
    segment.transparency = behind;
    segment.first = facts->first;
    segment.mean = facts->mean;
    segment.radiance_error = facts->radiance_error;
    segment.transparency_error = facts->transparency_error;
    segment.front_edge = facts->front_edge;
    segment.back_edge = facts->back_edge;
    PixelDetails& pixel = details_[at];
    pixel.add(segment, transparency,
              std::max({pixels_.red[at], pixels_.green[at], pixels_.blue[at]}));
    pixel.cells += facts->cells - 1;  // `add` counts the run as one
    pixel.violations += facts->violations + (is_late ? 1 : 0);
  }
  add_light(at, run.light);
}

// Whether what lies behind is seen.
bool MergedTile::composite(const EdgedSegment& segment) {
  const std::size_t at = segment.pixel;
  const double transparency = pixels_.transparency[at];
  if (transparency <= constants_.least_transparency) return false;
  const bool is_late = note_place(at, segment.front, segment.back);
  if (constants_.with_details) {
    PixelDetails& pixel = details_[at];
    pixel.add(segment.details, transparency,
              std::max({pixels_.red[at], pixels_.green[at], pixels_.blue[at]}));
    pixel.violations += is_late ? 1 : 0;
  }
  if (segment.is_edge) covers_[at] *= segment.light.transparency;
  add_light(at, segment.light);
  return pixels_.transparency[at] > constants_.least_transparency;
}

// Whether what lies there begins before all in front of it has ended, which is counted.
bool MergedTile::note_place(std::size_t at, double front, double back) {
  double& last = pixels_.last[at];
  const bool is_late = out_of_order(front, back, last, constants_.witness_tolerance);
  if (is_late) ++counts_.violations;
  last = std::max(last, back);
  return is_late;
}

void MergedTile::add_light(std::size_t at, const PlainRadiance& light) {
  double& transparency = pixels_.transparency[at];
  pixels_.red[at] += transparency * light.rgb[0];
  pixels_.green[at] += transparency * light.rgb[1];
  pixels_.blue[at] += transparency * light.rgb[2];
  transparency *= light.transparency;
}

double MergedTile::error(std::size_t at, double background) {
  const double left = pixels_.transparency[at];
  return pixel_error(constants_.largest_light, details_[at], left,
                     left <= constants_.least_transparency, background);
}

}  // namespace hiac
