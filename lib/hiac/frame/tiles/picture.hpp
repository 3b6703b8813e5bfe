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

struct RenderStatistics {
  std::uint64_t segments = 0;    ///< ray segments integrated, one for each cell that a ray meets
  std::uint64_t violations = 0;  ///< segments that the order had in the wrong place (section 4)
  double mean_optical_depth = 0,
         largest_optical_depth = 0;  ///< over the pixels that the mesh covers
  std::uint64_t covered_pixels = 0;
  std::uint64_t splatted_cells = 0;  ///< in the whole picture, also where a part is rendered
  double prepare_seconds = 0, tile_seconds = 0;

  /// Those of two parts of a picture together.
  RenderStatistics& operator+=(const RenderStatistics& other);
};

struct RenderResult {
  /// "R" "G" "B" "A", premultiplied, linear; A is 1 - transparency; then the channels asked for.
  Image image;
  RenderStatistics statistics;
};

/// What is wanted of a picture.
struct PictureParts {
  PixelRect part;        ///< which pixels; inside the picture
  bool with_background;  ///< composite the scene's background behind the volume
  std::span<const Channel> channels = {};
};

/// What the frame has to know of pixels for some channels.
Details details_for(std::span<const Channel> channels);

/// The picture that an engine draws tile by tile, in parallel, whatever the engine: its image,
/// what it counts, and the time that the tiles take. `progress`: told how many tiles are done,
/// where there is one.
RenderResult draw_picture(const Frame& frame, const Scene& scene, const TileBins& bins,
                          const PictureParts& wanted, const DrawTile& draw, Progress* progress);

}  // namespace hiac
