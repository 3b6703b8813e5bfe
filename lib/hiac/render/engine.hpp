#pragma once

#include <memory>
#include <span>

#include "hiac/base/progress.hpp"
#include "hiac/frame/channels.hpp"
#include "hiac/frame/crop.hpp"
#include "hiac/frame/tiles/picture.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// The accurate engine (Williams, Max, Stein 1998, sections 4 and 5): cells are projected tile by
/// tile in visibility order, front to back; every pixel centre that a cell covers yields one ray
/// segment, cut at the breakpoints of the transfer functions, integrated in closed form, and
/// composited in double precision. Groups of cells are put in order pixel by pixel. The same input
/// gives the same image, bit for bit, whatever the number of threads.
///
/// Requires what check_renderable (renderable.hpp) lets pass. `with_background`: composite the
/// scene's background behind the volume. `progress`: receives the number of finished tiles; may be
/// null. `channels`: what the picture says of its pixels besides. They change none of the others.
/// Throws UsageError for the error of an integration other than exact, or of splats: no bound is
/// claimed of those.
RenderResult render(const ZooMesh& mesh, const VisibilityOrder& order, const Scene& scene,
                    bool with_background, Progress* progress = nullptr,
                    std::span<const Channel> channels = {});

/// Renders a picture part by part. What the parts share is computed once.
class PartRenderer {
 public:
  /// Mesh, order and scene must outlive it. `channels` and what is thrown are those of render.
  /// `crew`: the processes that share the work, all of which do the same; null: this one alone.
  PartRenderer(const ZooMesh& mesh, const VisibilityOrder& order, const Scene& scene,
               std::span<const Channel> channels = {}, const TileCrew* crew = nullptr);
  ~PartRenderer();
  PartRenderer(const PartRenderer&) = delete;
  PartRenderer& operator=(const PartRenderer&) = delete;

  /// An image of the part alone, with the pixels of the whole picture, bit for bit. Only the tiles
  /// that meet the part are worked on; segments and violations are counted in all of these,
  /// optical depths and covered pixels in the part. Throws UsageError as require_inside does.
  [[nodiscard]] RenderResult render(const PixelRect& part, bool with_background,
                                    Progress* progress = nullptr) const;

  /// The time that construction took; the parts' statistics do not include it.
  [[nodiscard]] double prepare_seconds() const;

 private:
  struct Prepared;
  std::unique_ptr<const Prepared> prepared_;
};

}  // namespace hiac
