#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/frame/projection.hpp"
#include "hiac/frame/tiles/drawn_tile.hpp"
#include "hiac/frame/tiles/picture.hpp"
#include "hiac/image/image.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// The results of a tile besides its pixels.
struct TileSummary {
  TileCounts counts;
  double optical_depth_sum = 0, optical_depth_most = 0;
  std::uint64_t covered = 0, with_depth = 0;  // pixels; those that tell the depth of the medium

  /// `surfaces`: the transparency of skin and edges alone (DrawnTile).
  void add_pixel(double transparency, double surfaces);
};

/// A tile as it goes into the picture.
struct FinishedTile {
  TileSummary summary;
  std::vector<double> values;  ///< of its pixels that are in the part (common_pixels), as in Image
};

/// The pixels of a tile that lie in the part of the picture; there is one.
PixelRect common_pixels(const TileRect& tile, const PixelRect& part);

/// Writes the pixels of a tile that lie in the part of the picture shown by the image.
TileSummary write_tile(DrawnTile& drawn, const TileRect& tile, const Projector& projector,
                       const Scene& scene, const PictureParts& wanted, Image& image);

/// The same on its own, and put into the image afterwards, where `part` is what the image shows.
FinishedTile finish_tile(DrawnTile& drawn, const TileRect& tile, const Projector& projector,
                         const Scene& scene, const PictureParts& wanted);
void put_tile(const FinishedTile& finished, const TileRect& tile, const PixelRect& part,
              Image& image);

/// The statistics of a picture of these tiles, without times; sums are in their order.
RenderStatistics statistics_of(std::span<const TileSummary> tiles);

}  // namespace hiac
