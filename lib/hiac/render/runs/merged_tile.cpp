#include "hiac/render/runs/merged_tile.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "hiac/render/bounds/pixel_error.hpp"
#include "hiac/render/pixels/compositor.hpp"

namespace hiac {
namespace {

constexpr std::size_t kPixels = kTileStride * kTileHeight;

struct Place {
  std::uint32_t part, run;
};

// All runs, by pixel and depth.
std::vector<Place> in_order(std::span<const TileRuns> parts) {
  std::vector<std::uint32_t> start(kPixels + 1, 0);
  for (const TileRuns& part : parts)
    for (const RayRun& run : part.runs) ++start[run.pixel + 1];
  for (std::size_t p = 1; p < start.size(); ++p) start[p] += start[p - 1];
  std::vector<Place> places(start.back());
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (std::uint32_t part = 0; part < parts.size(); ++part)
    for (std::uint32_t run = 0; run < parts[part].runs.size(); ++run)
      places[next[parts[part].runs[run].pixel]++] = {part, run};
  const auto nearer = [&](const Place& a, const Place& b) {
    const RayRun &p = parts[a.part].runs[a.run], &q = parts[b.part].runs[b.run];
    if (p.front != q.front) return p.front < q.front;
    if (p.back != q.back) return p.back < q.back;
    return a.part != b.part ? a.part < b.part : a.run < b.run;
  };
  for (std::size_t p = 0; p < kPixels; ++p)
    if (start[p + 1] - start[p] > 1)
      std::sort(places.begin() + start[p], places.begin() + start[p + 1], nearer);
  return places;
}

}  // namespace

MergeConstants merge_constants(const Frame& frame) {
  return {frame.least_transparency, frame.witness_tolerance, frame.largest_light,
          frame.with_details};
}

MergedTile::MergedTile(const MergeConstants& constants, std::span<const TileRuns> parts)
    : constants_(constants), details_(constants.with_details ? kPixels : 0) {
  pixels_.red.fill(0);
  pixels_.green.fill(0);
  pixels_.blue.fill(0);
  pixels_.transparency.fill(1);
  pixels_.last.fill(-std::numeric_limits<double>::infinity());
  for (const TileRuns& part : parts) counts_ += part.counts;
  for (const Place& place : in_order(parts)) {
    const TileRuns& part = parts[place.part];
    composite(part.runs[place.run], part.facts.empty() ? nullptr : &part.facts[place.run]);
  }
}

void MergedTile::composite(const RayRun& run, const RunFacts* facts) {
  const std::size_t at = run.pixel;
  double& transparency = pixels_.transparency[at];
  if (transparency <= constants_.least_transparency) return;
  double& last = pixels_.last[at];
  const bool is_late = out_of_order(run.front, run.back, last, constants_.witness_tolerance);
  if (is_late) ++counts_.violations;
  last = std::max(last, run.back);
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
  pixels_.red[at] += transparency * rgb[0];
  pixels_.green[at] += transparency * rgb[1];
  pixels_.blue[at] += transparency * rgb[2];
  transparency *= behind;
}

double MergedTile::error(std::size_t at, double background) {
  const double left = pixels_.transparency[at];
  return pixel_error(constants_.largest_light, details_[at], left,
                     left <= constants_.least_transparency, background);
}

}  // namespace hiac
