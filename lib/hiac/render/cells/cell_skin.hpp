#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hiac/element/cell_field.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/frame/tiles/pixel_mask.hpp"
#include "hiac/frame/tiles/tile.hpp"
#include "hiac/geometry/inverse_map.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/cells/face_normals.hpp"
#include "hiac/render/integrate/isosurface_shading.hpp"

namespace hiac {

/// Where the ray of pixel (x, y) meets the skin of a cell.
struct SkinCrossing {
  int x, y;
  double t;  ///< ray parameter: the one at which the cell's segment begins or ends
  bool enters;
  std::uint8_t face;                ///< of the cell
  std::array<double, 3> reference;  ///< of the point if the face is curved, otherwise NaN
  double doubt;                     ///< CellCrossing::front_doubt or back_doubt
};

/// The skin on one cell's boundary faces: where the rays of a tile meet it, and what they see
/// there.
///
/// The crossings are those of the cell itself (scan_cell): a ray that enters or leaves the cell
/// through a face of the skin meets the skin there, once. So the skin has no holes along the edges
/// between its faces, and no ray meets it twice there.
///
/// The normal is that of the face's plane or, on curved faces, of the isoparametric surface; the
/// colour's field is the cell's interpolant at the point.
class CellSkin {
 public:
  explicit CellSkin(const Frame& frame) : frame_(frame) {}

  /// Selects a cell and finds the crossings with rays of the tile that z-clipping leaves; `only`
  /// with rays of these pixels, if it is not null.
  void enter(CellId cell, const TileRect& tile, const PixelMask* only = nullptr);

  /// The crossings of the selected cell with these rays, whatever faces they pass.
  [[nodiscard]] std::span<const CellCrossing> rays() const { return scanned_; }
  /// The crossings of the selected cell's skin: ray by ray, front to back.
  [[nodiscard]] std::span<const SkinCrossing> crossings() const { return crossings_; }
  /// Whether no ray crosses the selected cell several times.
  [[nodiscard]] bool is_met_once() const { return is_met_once_; }

  /// Whether a curved face of the selected cell turns one side to the ray of pixel (x, y) all the
  /// way between two of its points (reference coordinates).
  [[nodiscard]] bool is_one_side(std::size_t face, const std::array<double, 3>& from,
                                 const std::array<double, 3>& to, int x, int y);

  /// What rays see at some of the crossings, given by their numbers: until the next call.
  /// `ray_scales`: TileBuffer::ray_scale of each.
  [[nodiscard]] std::span<const ShadedPoint> shade(std::span<const std::uint32_t> which,
                                                   std::span<const double> ray_scales);

  /// The value, at a crossing, of the field that decides the colour. There is one.
  [[nodiscard]] double value_at(const SkinCrossing& crossing);

 private:
  [[nodiscard]] std::array<double, 3> normal_of(std::size_t face);
  const MappedCell& shape();

  const Frame& frame_;
  // of the selected cell
  CellId cell_ = 0;
  bool is_met_once_ = true;
  std::vector<CellCrossing> scanned_;
  std::vector<SkinCrossing> crossings_;
  // of the selected cell, once they are needed
  std::array<std::optional<std::array<double, 3>>, 6> normals_;  // of planar faces
  std::optional<MappedCell> shape_;
  std::optional<CellMap> map_;
  std::optional<CellField> field_;
  std::vector<ShadedPoint> shaded_;
};

}  // namespace hiac
