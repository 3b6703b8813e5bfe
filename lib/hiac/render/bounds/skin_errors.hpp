#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "hiac/element/cell_field.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/render/bounds/error_bound.hpp"
#include "hiac/render/bounds/ray_displacement.hpp"
#include "hiac/render/bounds/skin_outline.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/cells/cell_skin.hpp"

namespace hiac {

/// Bounds of the errors of the skin on one cell, for the channel `error` (error_bound.hpp).
class SkinErrors {
 public:
  /// Needs Frame::with_error.
  explicit SkinErrors(const Frame& frame) : frame_(frame) {}

  /// Selects a cell with skin. `rays`: its crossings with the rays of the tile, whether or not
  /// z-clipping leaves them.
  void enter(CellId cell, const TileRect& tile, std::span<const CellCrossing> rays);

  /// Adds the bounds of a crossing of the selected cell's skin. `at`: the pixel's index in the
  /// tile's planes; `seen`: what the ray sees there; `value`: of the field that decides the colour,
  /// or NaN.
  void add(const SkinCrossing& crossing, std::size_t at, const ShadedPoint& seen, double value,
           SegmentDetails& details);

  /// The pixels in which rounding may hide the skin of the selected cell, or show it, each once.
  [[nodiscard]] std::span<const std::size_t> hidden() const { return hidden_; }

 private:
  // The field that colours the skin, in a cell; `aside`: RayDisplacement.
  struct CellValues {
    CellField nodes;
    double gradient, aside;
  };

  [[nodiscard]] double place_doubt(std::size_t face, int x, int y, double curved_doubt) const;
  void add_clipped(const TileRect& tile, std::span<const CellCrossing> rays);
  [[nodiscard]] std::span<const OutlineDoubt> doubts_at(std::size_t at) const;
  [[nodiscard]] static bool is_hidden(std::span<const OutlineDoubt> doubts);
  double normal_doubt(const SkinCrossing& crossing, double moved);
  [[nodiscard]] CellValues values_in(CellId cell, double aside) const;
  double value_error(double moved);
  [[nodiscard]] bool add_other(const OutlineDoubt& doubt, const SkinCrossing& crossing,
                               double& moved, double& value) const;

  const Frame& frame_;
  // of the selected cell
  CellId cell_ = 0;
  RayDisplacement displacement_;
  EndDoubts end_doubts_;
  std::vector<OutlineDoubt> doubts_;  // by pixel
  std::vector<std::size_t> hidden_;
  std::array<std::optional<double>, 6> normal_doubts_;  // of planar faces, once needed
  std::optional<CellValues> values_;                    // once needed
};

}  // namespace hiac
