#pragma once

#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/render/bounds/error_bound.hpp"
#include "hiac/render/cells/cell_scalars.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/refine/extended_cell.hpp"
#include "hiac/render/refine/extended_cell_fields.hpp"
#include "hiac/render/refine/extended_cell_surfaces.hpp"
#include "hiac/render/refine/extended_segment.hpp"

namespace hiac {

/// Finds the segments of pixels' rays in linear cells with planar faces other than tetrahedra, in
/// extended precision, as ExtendedSegments does in tetrahedra: by the method of general_cells.cpp
/// and with its bounds, in the unit of extended precision.
///
/// Because coordinates are rounded, the corners of faces that count as planar deviate slightly from
/// a plane. Entry and exit points are therefore off by that deviation as well. Over that distance
/// alone the field may be that of the neighbour; it differs from this cell's field by at most the
/// change of both fields over that distance.
class ExtendedCellSegments {
 public:
  /// Needs Frame::with_error.
  explicit ExtendedCellSegments(const Frame& frame)
      : frame_(frame), fields_(frame), surfaces_(frame, fields_) {}
  // surfaces_ refers to fields_
  ExtendedCellSegments(const ExtendedCellSegments&) = delete;
  ExtendedCellSegments& operator=(const ExtendedCellSegments&) = delete;

  using Met = ExtendedTetrahedron::Met;
  /// Finds the segment of pixel (x, y) in a cell, if there is one to draw. The result is doubtful
  /// if the ray meets the cell more than once or along a face, or if the cell has curved faces or
  /// is so flat that reference coordinates are not found.
  Met find(CellId cell, int x, int y, ExtendedSegment& segment);

 private:
  using Real = long double;
  using Field = ExtendedCell::Field;

  // The light accumulated in front of a point in the cell, with the bounds of its integrals.
  struct Part {
    ExtendedLight light;
    ErrorBound quadrature;
  };

  void load(CellId cell, const ExtendedCell& geometry, const ExtendedRay& ray);
  Met meet(CellId cell, int x, int y);
  bool clip(const ExtendedCell& geometry, const ExtendedRay& ray, ExtendedStretch& stretch) const;
  bool find_fields(const ExtendedCell& geometry, const ExtendedRay& ray, Real front, Real back);
  bool add_volume(const ExtendedCell& geometry, const ExtendedRay& ray, Real front, Real back,
                  Part& sum);
  [[nodiscard]] FieldDoubt with_ends(FieldDoubt doubt, const ExtendedCellField& known, double slope,
                                     double jump, const ExtendedStretch& stretch) const;
  bool describe(const ExtendedCell& geometry, const ExtendedRay& ray,
                const ExtendedStretch& stretch, const Part& sum, SegmentDetails& details);

  const Frame& frame_;
  // of the current cell
  CellId cell_ = 0;
  bool empty_ = false;  // neither absorbs nor shines
  CellScalars color_{}, extinction_{};
  ExtendedCellFields fields_;
  ExtendedCellField known_color_, known_extinction_;
  CellOptics optics_;
  // of the current segment
  ExtendedCellSurfaces surfaces_;
  std::vector<ExtendedCell::Piece> pieces_;
  std::vector<BasicRootEnclosure<Real>> roots_;
  std::vector<CellCrossing> crossings_;
};

}  // namespace hiac
