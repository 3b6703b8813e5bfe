#pragma once

#include <cstdint>
#include <span>

#include "hiac/base/progress.hpp"
#include "hiac/image/image.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/render/channels.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

struct RenderStatistics {
  std::uint64_t segments = 0;    ///< ray segments integrated, one for each cell that a ray meets
  std::uint64_t violations = 0;  ///< segments that the order had in the wrong place (section 4)
  double mean_optical_depth = 0,
         largest_optical_depth = 0;  ///< over the pixels that the mesh covers
  std::uint64_t covered_pixels = 0;
  double prepare_seconds = 0, tile_seconds = 0;
};

struct RenderResult {
  /// "R" "G" "B" "A", premultiplied, linear; A is 1 - transparency; then the channels asked for.
  Image image;
  RenderStatistics statistics;
};

/// The accurate engine (Williams, Max, Stein 1998, sections 4 and 5): cells are projected tile by
/// tile in visibility order, front to back; every pixel centre that a cell covers yields one ray
/// segment, cut at the breakpoints of the transfer functions, integrated in closed form, and
/// composited in double precision. Groups of cells are put in order pixel by pixel. The same input
/// gives the same image, bit for bit, whatever the number of threads.
///
/// Requires what check_renderable (renderable.hpp) lets pass.
/// `with_background`: composite the scene's background behind the volume.
/// `progress`: told how many tiles are done, where there is one.
/// `channels`: what the picture says of its pixels besides. They change none of the others. Throws
/// UsageError for the error of an integration other than exact: no bound is claimed of those.
RenderResult render(const ZooMesh& mesh, const VisibilityOrder& order, const Scene& scene,
                    bool with_background, Progress* progress = nullptr,
                    std::span<const Channel> channels = {});

}  // namespace hiac
