#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/optics/polynomial_roots.hpp"
#include "hiac/render/bounds/error_bound.hpp"
#include "hiac/render/bounds/ray_displacement.hpp"
#include "hiac/render/refine/extended_cell.hpp"
#include "hiac/render/refine/extended_cell_fields.hpp"
#include "hiac/render/refine/extended_light.hpp"

namespace hiac {

/// The part of a ray inside a cell and the view, and how far its ends may be off, world units.
struct ExtendedStretch {
  long double front, back;
  bool front_clipped, back_clipped;
  std::uint8_t front_face, back_face;
  double length;
  BasicEndDoubts<long double>::Doubts doubts;
};

/// Where a ray crosses an isosurface, and what it sees there.
struct ExtendedCrossing {
  const FrameIsosurface* surface;
  long double t;
  double moved;  ///< bound of the error of t
  ExtendedLight light;
  ErrorBound shade_error;
};

/// Finds where rays cross the isosurfaces in one linear cell, in extended precision, as
/// CutsAlongRay does in doubles.
class ExtendedCellSurfaces {
 public:
  ExtendedCellSurfaces(const Frame& frame, const ExtendedCellFields& fields)
      : frame_(frame), fields_(fields) {}

  /// Finds the crossings of the surfaces in the fields' cell, front to back. Returns false if a
  /// point's reference coordinates are not found.
  bool find(const ExtendedCell& geometry, const ExtendedRay& ray, const ExtendedStretch& stretch);
  [[nodiscard]] const std::vector<ExtendedCrossing>& crossed() const { return crossed_; }
  /// Whether it is uncertain which surfaces are crossed.
  [[nodiscard]] bool doubtful() const { return doubtful_; }

 private:
  using Real = long double;

  void find_places(const IsosurfaceCut& cut, const CellField& offsets,
                   const ExtendedCellField& known, const ExtendedStretch& stretch,
                   std::vector<Real>& moved);
  bool add(const ExtendedCell& geometry, const ExtendedRay& ray, const ExtendedStretch& stretch,
           const IsosurfaceCut& cut);
  bool shade(const ExtendedCell& geometry, const ExtendedRay& ray, const ExtendedStretch& stretch,
             const ExtendedCellField& known, ExtendedCrossing& crossed) const;

  const Frame& frame_;
  const ExtendedCellFields& fields_;
  // of the current ray
  std::vector<ExtendedCrossing> crossed_;
  bool doubtful_ = false;
  std::vector<ExtendedCell::Piece> pieces_;
  std::vector<BasicRootEnclosure<Real>> roots_;
  std::vector<Real> places_;
};

}  // namespace hiac
