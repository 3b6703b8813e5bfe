#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hiac/base/transfer_function.hpp"
#include "hiac/frame/frame_field.hpp"
#include "hiac/frame/surfaces/skin_sides.hpp"
#include "hiac/frame/surfaces/surface_look.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The scene's skin as the engine draws it, and the faces that it covers: those that no other cell
/// has, and those that more than two cells have (FaceAdjacency), one for each of these cells. Each
/// face belongs to one cell, in front of which or behind which it is drawn.
struct FrameSkin {
  std::vector<std::uint8_t> faces;  ///< of every cell, a bit for each face; empty without a skin
  SurfaceLook look{};
  std::optional<FrameField> field;  ///< decides the colour, through `colors`; without intervals
  PiecewiseLinear<3> colors;
  std::vector<FrameLight> lights;
  double largest_light = 0;     ///< upper bound of the skin's light, any channel
  std::vector<SkinSide> sides;  ///< skin_sides; empty unless errors are requested

  /// The faces of a cell that the skin covers, a bit each.
  [[nodiscard]] unsigned on(CellId cell) const { return faces.empty() ? 0 : faces[cell]; }
};

/// Without a skin the result is empty. Throws UsageError, as scalar_field does, if the field does
/// not exist.
FrameSkin make_skin(const ZooMesh& mesh, const Scene& scene, const Projector& projector);

/// An upper bound of the light of a skin, any channel, whatever its field's values are.
double largest_light(const Skin& skin, std::span<const Light> lights);

}  // namespace hiac
