#pragma once

#include <cstdint>
#include <vector>

#include "hiac/frame/tiles/tile.hpp"
#include "hiac/optics/piece_rule.hpp"
#include "hiac/render/runs/edged_pixels.hpp"

namespace hiac {

/// A maximal run of a pixel's ray through a part of a mesh: ray segments each of which begins, to
/// the bit, where the one before it ends. Nothing of another part lies inside it, as cells do not
/// overlap, so that the runs of all parts, sorted by depth, make the ray through the whole mesh.
struct RayRun {
  double front, back;   ///< ray parameters
  PlainRadiance light;  ///< of the run alone
  std::uint32_t pixel;  ///< index into the tile's planes
};

/// What further channels need of a run. Depths are ray parameters.
struct RunFacts {
  double first = 0;  ///< where it begins to emit or absorb; infinite if it does not
  double mean = 0;   ///< depth of its opacity
  double radiance_error = 0, transparency_error = 0;  ///< ErrorBound of the run alone
  double front_edge = 0, back_edge = 0;               ///< further errors where no other run adjoins
  std::uint32_t cells = 0, violations = 0;
};

/// The transparency of all that a ray meets of the skin of a part.
struct SkinCover {
  std::uint32_t pixel;  ///< index into the tile's planes
  double transparency;
};

/// What one part of a mesh contributes to a tile.
struct TileRuns {
  std::vector<RayRun> runs;       ///< by pixel; those of a pixel front to back
  std::vector<RunFacts> facts;    ///< of each run; empty where no channel needs them
  std::vector<SkinCover> covers;  ///< of the pixels in which the part has skin
  EdgedTile edged;                ///< all of the pixels that have edges
  TileCounts counts;
};

}  // namespace hiac
