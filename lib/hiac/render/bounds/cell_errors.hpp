#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hiac/element/field_along_ray.hpp"
#include "hiac/render/bounds/error_bound.hpp"
#include "hiac/render/bounds/ray_displacement.hpp"
#include "hiac/render/cells/cell_scalars.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/cells/cuts_along_ray.hpp"
#include "hiac/render/pixels/pixel_details.hpp"

namespace hiac {

/// Bounds of the errors of segments in a cell of any kind, besides that of their quadrature, for
/// the channel `error` (error_bound.hpp).
class CellErrors {
 public:
  /// `longest`: the length of the longest segment, world units.
  CellErrors(const Frame& frame, double longest) : frame_(frame), longest_(longest) {}

  /// Selects a cell of the frame's mesh. `nodes`: its relative_positions. The fields must outlive
  /// every later call for this cell.
  void enter(CellId cell, std::span<const CellMap::Point> nodes, const CellScalars& color,
             const CellScalars& extinction, const RayDisplacement& displacement);

  /// The surfaces that cross a segment, and CutsAlongRay::doubtful.
  struct Cut {
    std::span<const IsosurfaceCrossing> surfaces;
    bool doubtful;
  };

  /// Adds the bounds of a segment to its details, which already hold the bound of its quadrature,
  /// its light and its transparency. `scale`: world length per unit of the ray parameter; `field`:
  /// the extinction's field and, if it differs, the colour's; `cut`: given if surfaces cross the
  /// cell.
  void add(const CellCrossing& crossing, const RayStretch& stretch, double scale,
           const FieldAlongRay& field, const std::optional<Cut>& cut, SegmentDetails& details);

 private:
  // One field in the cell, and its error.
  struct Field {
    const CellScalars* scalars = nullptr;
    double error = 0;
  };

  void add_doubts(const RayStretch& stretch, const FieldAlongRay& field, double length,
                  FieldDoubt& color, FieldDoubt& extinction);
  void add_edges(const CellCrossing& crossing, const RayStretch& stretch,
                 SegmentDetails& details) const;

  const Frame& frame_;
  double longest_;
  // of the current cell
  Field color_, extinction_;
  CellOptics optics_;
  EndDoubts end_doubts_;
  RayDisplacement displacement_;
  bool curved_ = false;  // the cell has curved faces
  std::vector<FieldAlongRay::Piece> pieces_;
  std::vector<RootEnclosure> roots_;
};

}  // namespace hiac
