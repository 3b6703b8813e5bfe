#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/render/runs/ray_runs.hpp"

namespace hiac {

/// A run of a tile: of which part, and which one of that part's.
struct RunPlace {
  std::uint32_t part, run;
};

/// All runs of a tile by pixel, in each pixel by depth: by their entry, then by their exit, then by
/// part.
std::vector<RunPlace> runs_by_depth(std::span<const TileRuns> parts);

/// The ray parameter behind which a tile shows nothing: no run that begins behind it is composited
/// in any pixel, whatever further parts there are. Infinite where a pixel does not end.
///
/// A ray ends with the first run that leaves at most `least_transparency` of what is behind it. A
/// further run cannot move that end back: transparencies are at most 1, and rounded products of
/// more such factors are not larger.
double end_of_tile(const TileRect& tile, std::span<const TileRuns> parts,
                   double least_transparency);

/// The least ray parameter at which a run begins; infinite where there is none.
double first_entry(const TileRuns& runs);

}  // namespace hiac
