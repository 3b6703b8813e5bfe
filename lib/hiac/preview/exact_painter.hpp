#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hiac/frame/crop.hpp"
#include "hiac/frame/projection.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/preview/context.hpp"
#include "hiac/preview/drawn_fields.hpp"
#include "hiac/preview/exact_shaders.hpp"
#include "hiac/preview/gl_objects.hpp"

namespace hiac::preview {

/// The method `exact`: every linear tetrahedron is rasterised once, as its silhouette; each pixel's
/// ray is cut at the cell's planes and at the breakpoints of the transfer functions, and the
/// integral of each piece is evaluated by a series in which nothing cancels (Williams, Max, Stein
/// 1998, equation (8), for a ray rather than for a vertex). The host projects the nodes; all else
/// that a view needs is computed on the device.
class ExactPainter {
 public:
  /// Of a mesh of linear tetrahedra. All have to outlive it. `fine`: double precision along rays.
  /// Throws DriverError when the mesh is too large for the driver.
  ExactPainter(const Context& context, const ZooMesh& mesh, const DrawnScene& scene, bool fine);

  /// For draw from now on.
  void set_view(const Projector& projector);

  /// Draws cells over the target that has begun, as that part, back to front as they come.
  void draw(const PixelRect& part, std::span<const CellId> back_to_front);

 private:
  void compile();
  void set_layout(std::size_t record_bytes);
  void upload_tables();
  void set_part(const PixelRect& part);
  void set_closed_faces(std::span<const CellId> cells);
  void draw_chunk(std::span<const CellId> cells);

  const Context& context_;
  const ZooMesh& mesh_;
  const DrawnScene& scene_;
  ExactVariant variant_;
  std::optional<ExactVariant> compiled_;
  ProgramName setup_, program_;
  Buffer nodes_, values_, corners_, numbers_, records_, outlines_, closed_, surfaces_, indices_;
  std::vector<Buffer> tables_;  // of transfer functions, and textures of these
  std::vector<TextureName> table_textures_;
  std::array<double, 3> rays_{};  // the picture's centre, pixels; one over the pixels per unit
  VertexArrayName layout_;        // refers to the indices
  std::vector<std::uint32_t> field_layouts_;  // two a field: first value, location
  std::size_t chunk_ = 0;                     // cells
  std::vector<NodeId> chunk_corners_;
};

}  // namespace hiac::preview
