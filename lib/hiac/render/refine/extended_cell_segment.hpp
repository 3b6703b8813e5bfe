#pragma once

#include <array>
#include <optional>
#include <vector>

#include "hiac/element/gradient/gradient_bound.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/render/bounds/error_bound.hpp"
#include "hiac/render/bounds/ray_displacement.hpp"
#include "hiac/render/cells/cell_scalars.hpp"
#include "hiac/render/cells/cell_scan.hpp"
#include "hiac/render/refine/extended_cell.hpp"
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
  explicit ExtendedCellSegments(const Frame& frame) : frame_(frame) {}

  using Met = ExtendedTetrahedron::Met;
  /// Finds the segment of pixel (x, y) in a cell, if there is one to draw. The result is doubtful
  /// if the ray meets the cell more than once or along a face, or if the cell has curved faces or
  /// is so flat that reference coordinates are not found.
  Met find(CellId cell, int x, int y, ExtendedSegment& segment);

 private:
  using Real = long double;
  using Field = ExtendedCell::Field;
  using Roots = std::vector<BasicRootEnclosure<Real>>;

  // A field in the cell and its errors.
  struct Known {
    Field field;
    double error;     // inside the cell
    double at_faces;  // in addition, at entry and exit points
  };
  // The part of the ray inside the cell, and how far its ends may be off, world units.
  struct Stretch {
    Real front, back;
    bool front_clipped, back_clipped;
    std::uint8_t front_face, back_face;
    double length;
    BasicEndDoubts<Real>::Doubts doubts;
  };
  struct Crossed {
    const FrameIsosurface* surface;
    Real t;
    double moved;  // bound of the error of t
    ExtendedLight light;
    ErrorBound shade_error;
  };
  // The light accumulated in front of a point in the cell, with the bounds of its integrals.
  struct Part {
    ExtendedLight light;
    ErrorBound quadrature;
  };

  void load(CellId cell, const ExtendedCell& geometry, const ExtendedRay& ray);
  [[nodiscard]] std::array<double, 8> node_values(const FrameField& field) const;
  [[nodiscard]] Known known(const CellField& nodes, const FrameField& field, double level) const;
  Met meet(CellId cell, int x, int y);
  bool clip(const ExtendedCell& geometry, const ExtendedRay& ray, Stretch& stretch) const;
  bool find_fields(const ExtendedCell& geometry, const ExtendedRay& ray, Real front, Real back);
  bool add_volume(const ExtendedCell& geometry, const ExtendedRay& ray, Real front, Real back,
                  Part& sum);
  void find_places(const IsosurfaceCut& cut, const CellField& offsets, const Known& known,
                   const Stretch& stretch, std::vector<Real>& moved);
  bool add_surface(const ExtendedCell& geometry, const ExtendedRay& ray, const Stretch& stretch,
                   const IsosurfaceCut& cut);
  bool shade(const ExtendedCell& geometry, const ExtendedRay& ray, const Stretch& stretch,
             const Known& known, Crossed& crossed) const;
  bool find_surfaces(const ExtendedCell& geometry, const ExtendedRay& ray, const Stretch& stretch);
  [[nodiscard]] FieldDoubt with_ends(FieldDoubt doubt, const Known& known, double slope,
                                     double jump, const Stretch& stretch) const;
  bool describe(const ExtendedCell& geometry, const ExtendedRay& ray, const Stretch& stretch,
                const Part& sum, SegmentDetails& details);

  const Frame& frame_;
  // of the current cell
  CellId cell_ = 0;
  bool empty_ = false;  // neither absorbs nor shines
  CellScalars color_{}, extinction_{};
  std::optional<GradientBound> gradient_;
  double steepness_ = 0;         // CellMap::steepness
  double reach_ = 0, bent_ = 0;  // ExtendedCell
  RayDisplacement inside_;
  Known known_color_{}, known_extinction_{};
  CellOptics optics_;
  // of the current segment
  std::vector<Crossed> crossed_;
  bool doubtful_ = false;  // it is uncertain which surfaces are crossed
  std::vector<ExtendedCell::Piece> pieces_;
  Roots roots_;
  std::vector<CellCrossing> crossings_;
  std::vector<Real> places_;
};

}  // namespace hiac
