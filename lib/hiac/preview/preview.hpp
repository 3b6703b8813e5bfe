#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "hiac/frame/crop.hpp"
#include "hiac/image/image.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/preview/context.hpp"
#include "hiac/preview/methods/method.hpp"
#include "hiac/preview/methods/region_filler.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::preview {

/// How a preview is drawn.
struct PreviewOptions {
  std::optional<Method> method = std::nullopt;  ///< of the paper; none: exact
  bool fine = false;                            ///< double precision along rays
  /// Pixels of a part's side; larger pictures are drawn in parts. 0: what suits the driver.
  std::uint32_t part_side = 0;
};

/// What a picture took, and what was met.
struct PreviewStatistics {
  double upload_seconds = 0;   ///< mesh and fields to the device, shaders compiled: once
  double regions_seconds = 0;  ///< homogeneous regions on the host, with one of the paper's methods
  double draw_seconds = 0;  ///< a view: nodes projected, cells prepared and drawn, and waited for
  double read_seconds = 0;
  RegionCounts regions;         ///< with one of the paper's methods
  std::uint64_t triangles = 0;  ///< of the regions
  std::uint64_t parts = 0;
  std::uint64_t groups = 0;           ///< visibility cycles, drawn by centroids
  std::uint64_t cells_in_groups = 0;  ///< cells in them
};

struct PreviewResult {
  Image image;  ///< "R" "G" "B" "A", premultiplied, linear
  PreviewStatistics statistics;
};

/// Draws previews of one mesh and scene. The camera may change from picture to picture.
class Preview {
 public:
  /// Of a mesh of linear tetrahedra (drawn_mesh). Context, mesh and scene have to outlive it.
  /// Requires what check_renderable lets pass. Throws DriverError, UsageError as scalar_field does,
  /// and std::invalid_argument for other cells.
  Preview(const Context& context, const ZooMesh& mesh, const Scene& scene,
          const PreviewOptions& options = {});
  ~Preview();
  Preview(const Preview&) = delete;
  Preview& operator=(const Preview&) = delete;

  /// The picture, or that part of it. `order`: of all cells; those of a group are drawn by the
  /// depth of their centroids. `with_background`: composite the scene's background behind.
  PreviewResult draw(const Camera& camera, const VisibilityOrder& order,
                     const std::optional<PixelRect>& part, bool with_background);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace hiac::preview
