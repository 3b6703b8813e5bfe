#pragma once

#include <cstdint>
#include <span>

#include "hiac/base/progress.hpp"
#include "hiac/frame/channels.hpp"
#include "hiac/frame/crop.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/frame/tiles/drawn_tile.hpp"
#include "hiac/frame/tiles/tile_bins.hpp"
#include "hiac/image/image.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

class TileCrew;

struct RenderStatistics {
  std::uint64_t segments = 0;    ///< ray segments integrated, one for each cell that a ray meets
  std::uint64_t violations = 0;  ///< segments out of order (section 4)
  /// Of the medium and the isosurfaces, over `depth_pixels`; 0 if there are none of these.
  double mean_optical_depth = 0, largest_optical_depth = 0;
  std::uint64_t covered_pixels = 0;
  /// The covered pixels that tell the depth of the medium: not those that show skin or edges alone,
  /// nor those in which these let less than a thousandth of the light behind them through.
  std::uint64_t depth_pixels = 0;
  std::uint64_t splatted_cells = 0;  ///< in the whole picture, even if only a part is rendered
  double prepare_seconds = 0, tile_seconds = 0;

  /// Adds the statistics of another part of the picture.
  RenderStatistics& operator+=(const RenderStatistics& other);
};

struct RenderResult {
  /// "R" "G" "B" "A", premultiplied, linear; A is 1 - transparency; then the requested channels.
  Image image;
  RenderStatistics statistics;
};

/// Which part of a picture is requested, and how.
struct PictureParts {
  PixelRect part;        ///< the pixels; must lie inside the picture
  bool with_background;  ///< composite the scene's background behind the volume
  std::span<const Channel> channels = {};
  const TileCrew* crew = nullptr;  ///< the processes that share the work; null: this one alone
};

/// The details of pixels that some channels require.
Details details_for(std::span<const Channel> channels);

/// Draws a picture tile by tile, in parallel, with any engine; returns the image and the
/// statistics. `progress`: receives the number of finished tiles; may be null.
RenderResult draw_picture(const Frame& frame, const Scene& scene, const TileBins& bins,
                          const PictureParts& wanted, const DrawTile& draw, Progress* progress);

}  // namespace hiac
