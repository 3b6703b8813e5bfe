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
  // where errors are asked for
  double moved = 0;          ///< what t may be wrong by
  ErrorBound shade_error{};  ///< of the shade
};

/// Whether rounding may have changed the order of crossings, front to back, of surfaces of
/// different fields or values. A crossing has `surface`, its place `t` and what that is `moved` by.
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

/// The isosurfaces that cross one cell of any kind, met along rays (section 5.2): where the
/// isoparametric interpolant takes their values, with its gradient as the normal.
class CutsAlongRay {
 public:
  explicit CutsAlongRay(const Frame& frame) : frame_(frame) {}

  /// Takes the surfaces of a cell; `displacement` is the cell's where errors are asked for. False,
  /// and nothing else may be asked, when there is none.
  bool enter(CellId cell, const RayDisplacement& displacement);

  /// Finds the fields along segments of the cell many at a time (interpolate_cell_segments), for
  /// `find`.
  void interpolate(const CellMap& map, CellSegments& segments);

  /// Replaces `found` by the crossings on a stretch, what `crossing` has after z-clipping, in the
  /// order in which they are met. `map`: of the cell; `segment`: the stretch's number among those
  /// of the last call of `interpolate`, if it is one of them.
  ///
  /// Between the enclosures of its roots (append_roots) the offset from a surface's value has a
  /// certain sign; what it is on the cell's faces is asked of the faces (face_value.hpp), so that
  /// neighbours agree. A crossing lies wherever one sign follows another.
  void find(const CellMap& map, const CellCrossing& crossing, const RayStretch& stretch,
            std::optional<std::size_t> segment, std::vector<IsosurfaceCrossing>& found);

  /// Whether the last call of `find` may have missed a crossing, or found one too many: with values
  /// higher and lower by the error of the field there are not as many. (Where errors are asked
  /// for.)
  [[nodiscard]] bool doubtful() const { return doubtful_; }

 private:
  struct Cut {
    const FrameIsosurface* surface;
    CellField offsets;
    std::array<FaceOffsets, 6> faces;
    std::uint8_t closed_faces;
    double error = 0;      // of the offsets
    SegmentPieces pieces;  // the offsets, where they were interpolated together
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
  // of the ray and the cut at hand
  std::vector<FieldAlongRay::Piece> pieces_;
  std::vector<RootEnclosure> roots_;
  std::vector<double> places_;
  std::vector<double> moved_, shifted_;  // what each place may be wrong by; scratch
  bool doubtful_ = false;
};

}  // namespace hiac
