#pragma once

#include <array>
#include <optional>
#include <vector>

#include "hiac/optics/polynomial_roots.hpp"
#include "hiac/render/cell_scan.hpp"
#include "hiac/render/face_value.hpp"
#include "hiac/render/field_along_ray.hpp"
#include "hiac/render/frame.hpp"
#include "hiac/render/isosurface_shading.hpp"

namespace hiac {

/// Where a ray crosses an isosurface, and what it sees there.
struct IsosurfaceCrossing {
  double t;
  IsosurfaceShade shade;
};

/// The isosurfaces that cross one linear cell of any kind, met along rays (section 5.2): where the
/// isoparametric interpolant takes their values, with its gradient as the normal.
class CutsAlongRay {
 public:
  explicit CutsAlongRay(const Frame& frame) : frame_(frame) {}

  /// Takes the surfaces of a cell. False, and nothing else may be asked, when there is none.
  bool enter(CellId cell);

  /// Replaces `found` by the crossings on a stretch, what `crossing` has after z-clipping, in the
  /// order in which they are met. `map`: of the cell.
  ///
  /// Between the enclosures of its roots (append_roots) the offset from a surface's value has a
  /// certain sign; what it is on the cell's faces is asked of the faces (face_value.hpp), so that
  /// neighbours agree. A crossing lies wherever one sign follows another.
  void find(const CellMap& map, const CellCrossing& crossing, const RayStretch& stretch,
            std::vector<IsosurfaceCrossing>& found);

 private:
  struct Cut {
    const FrameIsosurface* surface;
    CornerField offsets;
    std::array<FaceOffsets, 6> faces;
    std::uint8_t closed_faces;
  };

  void add_places(const CellMap& map, const CellCrossing& crossing, const RayStretch& stretch,
                  const Cut& cut);
  [[nodiscard]] bool below_at_face(const Cut& cut, const CellCrossing& crossing, std::size_t face,
                                   double t, double offset) const;
  [[nodiscard]] IsosurfaceShade shade(const CellMap& map, const CellCrossing& crossing,
                                      const RayStretch& stretch, const Cut& cut, double t) const;

  const Frame& frame_;
  CellKind kind_{};
  std::vector<Cut> cuts_;
  std::array<CellMap::Point, CellMap::kMostCorners> corners_{};
  // of the ray and the cut at hand
  std::vector<FieldAlongRay::Piece> pieces_;
  std::vector<RootEnclosure> roots_;
  std::vector<double> places_;
};

}  // namespace hiac
