#include "hiac/render/pixels/tile.hpp"

#include <algorithm>
#include <limits>

#include "hiac/render/pixels/compositor.hpp"

namespace hiac {

void TileBuffer::reset(const TileRect& tile, const Projector& projector, bool with_details) {
  red.fill(0);
  green.fill(0);
  blue.fill(0);
  transparency.fill(1);
  last.fill(-std::numeric_limits<double>::infinity());
  ray_scale.fill(1);
  details.assign(with_details ? red.size() : 0, {});
  if (!projector.perspective()) return;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x)
      ray_scale[tile.index(x, y)] = projector.ray_scale(pixel_center(x), pixel_center(y));
}

void SegmentList::clear() {
  pixel.clear();
  details.clear();
  for (auto* array : {&front, &back, &red, &green, &blue, &transparency}) array->clear();
}

void SegmentList::append(std::size_t at, double t_front, double t_back,
                         const PlainRadiance& light) {
  pixel.push_back(static_cast<std::uint32_t>(at));
  front.push_back(t_front);
  back.push_back(t_back);
  red.push_back(light.rgb[0]);
  green.push_back(light.rgb[1]);
  blue.push_back(light.rgb[2]);
  transparency.push_back(light.transparency);
}

bool SegmentList::nearer(std::uint32_t a, std::uint32_t b) const {
  if (front[a] != front[b]) return front[a] < front[b];
  return back[a] != back[b] ? back[a] < back[b] : a < b;
}

void composite_sorted(const SegmentList& segments, double witness_tolerance, TileBuffer& buffer,
                      TileCounts& counts) {
  // counting sort by pixel, then a comparison sort of each pixel's few segments by depth
  std::vector<std::uint32_t> start(kTileStride * kTileHeight + 1, 0);
  for (const std::uint32_t p : segments.pixel) ++start[p + 1];
  for (std::size_t p = 1; p < start.size(); ++p) start[p] += start[p - 1];
  std::vector<std::uint32_t> sorted(segments.size());
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (std::uint32_t s = 0; s < segments.size(); ++s) sorted[next[segments.pixel[s]]++] = s;

  const auto nearer = [&](std::uint32_t a, std::uint32_t b) { return segments.nearer(a, b); };
  for (std::size_t p = 0; p + 1 < start.size(); ++p) {
    std::sort(sorted.begin() + start[p], sorted.begin() + start[p + 1], nearer);
    for (std::uint32_t i = start[p]; i < start[p + 1]; ++i) {
      const std::uint32_t s = sorted[i];
      if (!segments.details.empty()) describe(p, segments.details[s], witness_tolerance, buffer);
      composite(p, segments.front[s], segments.back[s], segments.light(s), witness_tolerance,
                buffer, counts);
    }
  }
}

}  // namespace hiac
