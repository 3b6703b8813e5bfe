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

/// Bounds of what segments in a cell of a general kind are wrong by besides their quadrature, as
/// the channel `error` claims them (error_bound.hpp).
class CellErrors {
 public:
  /// `longest`: of segments, world units.
  CellErrors(const Frame& frame, double longest) : frame_(frame), longest_(longest) {}

  /// Takes a cell of the frame's mesh. `nodes`: relative_positions; the fields must outlive what is
  /// asked of it.
  void enter(CellId cell, std::span<const CellMap::Point> nodes, const CellScalars& color,
             const CellScalars& extinction, const RayDisplacement& displacement);

  /// The surfaces that cross a segment, and CutsAlongRay::doubtful.
  struct Cut {
    std::span<const IsosurfaceCrossing> surfaces;
    bool doubtful;
  };

  /// Adds the bounds of a segment to its details, which have its quadrature's, its light and its
  /// transparency. `scale`: world length per unit of the ray parameter; `field`: the extinction's
  /// and, where it is another one, the colour's; `cut`: where surfaces cross the cell.
  void add(const CellCrossing& crossing, const RayStretch& stretch, double scale,
           const FieldAlongRay& field, const std::optional<Cut>& cut, SegmentDetails& details);

 private:
  // One field in the cell, and what it may be wrong by.
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
  // of the cell at hand
  Field color_, extinction_;
  CellOptics optics_;
  EndDoubts end_doubts_;
  RayDisplacement displacement_;
  bool curved_ = false;  // it has curved faces
  std::vector<FieldAlongRay::Piece> pieces_;
  std::vector<RootEnclosure> roots_;
};

}  // namespace hiac
