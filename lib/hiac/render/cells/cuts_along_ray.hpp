#pragma once

#include <array>
#include <optional>
#include <vector>

#include "hiac/element/field_along_ray.hpp"
#include "hiac/frame/face_value.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/optics/polynomial_roots.hpp"
#include "hiac/render/bounds/error_bound.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/integrate/cell_interpolants.hpp"
#include "hiac/render/integrate/isosurface_shading.hpp"

namespace hiac {

/// Where a ray crosses an isosurface, and what it sees there.
struct IsosurfaceCrossing {
  double t;
  const FrameIsosurface* surface;
  IsosurfaceShade shade;
  // if errors are requested
  double moved = 0;          ///< bound of the error of t
  ErrorBound shade_error{};  ///< that of the shade
};

/// Whether rounding may have changed the front-to-back order of crossings of surfaces of different
/// fields or values. A crossing has `surface`, its position `t` and the bound `moved` of the error
/// of t.
template <class Crossing>
bool order_doubtful(const std::vector<Crossing>& found) {
  for (std::size_t i = 0; i + 1 < found.size(); ++i)
    for (std::size_t j = i + 1; j < found.size(); ++j) {
      const Crossing &a = found[i], &b = found[j];
      const bool same =
          a.surface->field == b.surface->field && a.surface->value == b.surface->value;
      if (!same && b.t - a.t <= a.moved + b.moved) return true;
    }
  return false;
}

/// Finds where rays cross the isosurfaces in one cell of any kind (section 5.2): where the
/// isoparametric interpolant takes their values. Its gradient is the normal.
class CutsAlongRay {
 public:
  explicit CutsAlongRay(const Frame& frame) : frame_(frame) {}

  /// Selects a cell and its surfaces; `displacement` is the cell's if errors are requested. Returns
  /// false if no surface crosses the cell; then no other function may be called.
  bool enter(CellId cell, const RayDisplacement& displacement);

  /// Finds the fields along segments of the cell many at a time (interpolate_cell_segments), for
  /// `find`.
  void interpolate(const CellMap& map, CellSegments& segments);

  /// Replaces `found` by the crossings on a stretch, which is `crossing` after z-clipping, front to
  /// back. `map` is that of the cell; `segment` is the stretch's index in the last call of
  /// `interpolate`, if it was part of that call.
  ///
  /// Between the enclosures of its roots (append_roots) the sign of the offset from a surface's
  /// value is certain; its sign on the cell's faces is computed from the faces alone
  /// (face_value.hpp), so that neighbours agree. A crossing lies wherever the sign changes.
  void find(const CellMap& map, const CellCrossing& crossing, const RayStretch& stretch,
            std::optional<std::size_t> segment, std::vector<IsosurfaceCrossing>& found);

  /// Whether the last call of `find` may have missed a crossing or found one too many: the number
  /// of crossings changes if the value is raised or lowered by the field's error. Computed only if
  /// errors are requested.
  [[nodiscard]] bool doubtful() const { return doubtful_; }

 private:
  struct Cut {
    const FrameIsosurface* surface;
    CellField offsets;
    std::array<FaceOffsets, 6> faces;
    std::uint8_t closed_faces;
    double error = 0;      // bound of the offsets' error
    SegmentPieces pieces;  // the offsets, if they were interpolated together
  };

  void add_places(const CellMap& map, const CellCrossing& crossing, const RayStretch& stretch,
                  std::optional<std::size_t> segment, const Cut& cut);
  [[nodiscard]] bool below_at_face(const Cut& cut, const CellCrossing& crossing, std::size_t face,
                                   double t, double offset) const;
  void add_doubts(const RayStretch& stretch, const Cut& cut, double error);
  [[nodiscard]] std::array<double, 3> normal_at(const CellMap& map, const RayStretch& stretch,
                                                const Cut& cut, double t, double& rounding) const;
  [[nodiscard]] IsosurfaceCrossing crossing_at(const CellMap& map, const CellCrossing& crossing,
                                               const RayStretch& stretch, const Cut& cut, double u,
                                               double moved) const;

  const Frame& frame_;
  CellKind kind_{};
  std::vector<Cut> cuts_;
  RayDisplacement displacement_;
  std::array<CellMap::Point, CellMap::kMostNodes> nodes_{};
  // of the current ray and cut
  std::vector<FieldAlongRay::Piece> pieces_;
  std::vector<RootEnclosure> roots_;
  std::vector<double> places_;
  std::vector<double> moved_, shifted_;  // the error of each place; scratch
  bool doubtful_ = false;
};

}  // namespace hiac
