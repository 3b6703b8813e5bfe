#include "hiac/render/runs/runs_by_depth.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace hiac {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
// More than the relative error of a product of a pixel's transparencies in any order.
constexpr double kRounding = 1e-9;

// Whether all pixels of the tile end, but for rounding: told without sorting the runs.
bool may_end(const TileRect& tile, std::span<const TileRuns> parts, double least_transparency) {
  std::vector<double> left(kTilePlane, 1);
  for (const TileRuns& part : parts)
    for (const RayRun& run : part.runs) left[run.pixel] *= run.light.transparency;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x)
      if (left[tile.index(x, y)] > least_transparency * (1 + kRounding)) return false;
  return true;
}

}  // namespace

std::vector<RunPlace> runs_by_depth(std::span<const TileRuns> parts) {
  std::vector<std::uint32_t> start(kTilePlane + 1, 0);
  for (const TileRuns& part : parts)
    for (const RayRun& run : part.runs) ++start[run.pixel + 1];
  for (std::size_t p = 1; p < start.size(); ++p) start[p] += start[p - 1];
  std::vector<RunPlace> places(start.back());
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (std::uint32_t part = 0; part < parts.size(); ++part)
    for (std::uint32_t run = 0; run < parts[part].runs.size(); ++run)
      places[next[parts[part].runs[run].pixel]++] = {part, run};
  const auto nearer = [&](const RunPlace& a, const RunPlace& b) {
    const RayRun &p = parts[a.part].runs[a.run], &q = parts[b.part].runs[b.run];
    if (p.front != q.front) return p.front < q.front;
    if (p.back != q.back) return p.back < q.back;
    return a.part != b.part ? a.part < b.part : a.run < b.run;
  };
  for (std::size_t p = 0; p < kTilePlane; ++p)
    if (start[p + 1] - start[p] > 1)
      std::sort(places.begin() + start[p], places.begin() + start[p + 1], nearer);
  return places;
}

double end_of_tile(const TileRect& tile, std::span<const TileRuns> parts,
                   double least_transparency) {
  if (!may_end(tile, parts, least_transparency)) return kNever;
  std::vector<double> left(kTilePlane, 1), ends(kTilePlane, kNever);
  for (const RunPlace& place : runs_by_depth(parts)) {
    const RayRun& run = parts[place.part].runs[place.run];
    if (left[run.pixel] <= least_transparency) continue;
    left[run.pixel] *= run.light.transparency;
    if (left[run.pixel] <= least_transparency) ends[run.pixel] = run.front;
  }
  double end = -kNever;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) end = std::max(end, ends[tile.index(x, y)]);
  return end;
}

double first_entry(const TileRuns& runs) {
  double first = kNever;
  for (const RayRun& run : runs.runs) first = std::min(first, run.front);
  return first;
}

}  // namespace hiac
