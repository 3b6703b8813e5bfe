#include "hiac/render/pixels/tile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/render/pixels/compositor.hpp"
#include "hiac/render/pixels/sorted_segments.hpp"

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

void SegmentList::prepend(const SegmentList& other) {
  segments.insert(segments.begin(), other.segments.begin(), other.segments.end());
  details.insert(details.begin(), other.details.begin(), other.details.end());
}

bool SegmentList::nearer(std::uint32_t a, std::uint32_t b) const {
  const ListedSegment &p = segments[a], &q = segments[b];
  if (p.front != q.front) return p.front < q.front;
  return p.back != q.back ? p.back < q.back : a < b;
}

std::vector<std::uint32_t> sorted_segments(const SegmentList& list) {
  // counting sort by pixel, then a comparison sort of each pixel's few segments by depth
  std::vector<std::uint32_t> start(kTilePlane + 1, 0);
  for (const ListedSegment& s : list.segments) ++start[s.pixel + 1];
  for (std::size_t p = 1; p < start.size(); ++p) start[p] += start[p - 1];
  std::vector<std::uint32_t> sorted(list.segments.size());
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (std::uint32_t s = 0; s < sorted.size(); ++s) sorted[next[list.segments[s].pixel]++] = s;
  const auto nearer = [&](std::uint32_t a, std::uint32_t b) { return list.nearer(a, b); };
  for (std::size_t p = 0; p + 1 < start.size(); ++p)
    std::sort(sorted.begin() + start[p], sorted.begin() + start[p + 1], nearer);
  return sorted;
}

SegmentDetails details_in_order(const SegmentList& list, std::span<const std::uint32_t> sorted,
                                std::size_t i) {
  const ListedSegment& here = list.segments[sorted[i]];
  SegmentDetails details = list.details[sorted[i]];
  if (details.part != RayPart::skin) return details;
  const auto is_swapped_with = [&](std::uint32_t k) {
    const SegmentDetails& other = list.details[k];
    return list.segments[k].pixel == here.pixel && other.part == RayPart::skin &&
           std::abs(list.segments[k].front - here.front) <= details.moved + other.moved;
  };
  const auto is_edge = [&](std::uint32_t k) { return list.details[k].part == RayPart::edge; };
  std::size_t before = i, behind = i + 1;  // edges between two skins do not keep them apart
  while (before > 0 && is_edge(sorted[before - 1])) --before;
  while (behind < sorted.size() && is_edge(sorted[behind])) ++behind;
  if ((before > 0 && is_swapped_with(sorted[before - 1])) ||
      (behind < sorted.size() && is_swapped_with(sorted[behind]))) {
    details.radiance_error = std::max(details.radiance_error, details.in_doubt);
    details.transparency_error = 1;
  }
  return details;
}

void composite_sorted(const SegmentList& list, double witness_tolerance, TileBuffer& buffer,
                      TileCounts& counts) {
  const std::vector<std::uint32_t> sorted = sorted_segments(list);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const ListedSegment& s = list.segments[sorted[i]];
    if (!list.details.empty())
      describe(s.pixel, details_in_order(list, sorted, i), witness_tolerance, buffer);
    composite(s.pixel, s.front, s.back, s.light, witness_tolerance, buffer, counts);
  }
}

}  // namespace hiac
