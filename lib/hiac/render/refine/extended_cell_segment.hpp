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

/// Finds the segments of pixels' rays in linear cells with planar faces that are no tetrahedra, in
/// extended precision, as ExtendedSegments does in tetrahedra: by the method of general_cells.cpp
/// and to its bounds, in the unit of extended precision.
///
/// Faces that count as planar are off their planes by as much as rounded coordinates make them. So
/// where the ray enters and leaves is off by that besides, and there alone the field may be that of
/// the neighbour, as far from this cell's as both change in as much.
class ExtendedCellSegments {
 public:
  /// Needs Frame::with_error.
  explicit ExtendedCellSegments(const Frame& frame) : frame_(frame) {}

  using Met = ExtendedTetrahedron::Met;
  /// The segment of pixel (x, y) in a cell, if there is one to draw. In doubt are cells that the
  /// ray meets more than once or along a face, with curved faces, or so flat that places in them
  /// are not found.
  Met find(CellId cell, int x, int y, ExtendedSegment& segment);

 private:
  using Real = long double;
  using Field = ExtendedCell::Field;
  using Roots = std::vector<BasicRootEnclosure<Real>>;

  // What is known of a field in the cell.
  struct Known {
    Field field;
    double error;     // what it is wrong by inside
    double at_faces;  // and where the ray enters and leaves, besides
  };
  // Part of the ray inside the cell, and what its ends may be off by in the world.
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
    double moved;  // what t may be wrong by
    ExtendedLight light;
    ErrorBound shade_error;
  };
  // What is in front of a place in the cell, with the bounds of its integrals.
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
  // of the cell at hand
  CellId cell_ = 0;
  bool empty_ = false;  // neither absorbs nor shines
  CellScalars color_{}, extinction_{};
  std::optional<GradientBound> gradient_;
  double steepness_ = 0;         // CellMap::steepness
  double reach_ = 0, bent_ = 0;  // ExtendedCell
  RayDisplacement inside_;
  Known known_color_{}, known_extinction_{};
  CellOptics optics_;
  // of the segment at hand
  std::vector<Crossed> crossed_;
  bool doubtful_ = false;  // what surfaces are crossed
  std::vector<ExtendedCell::Piece> pieces_;
  Roots roots_;
  std::vector<CellCrossing> crossings_;
  std::vector<Real> places_;
};

}  // namespace hiac
