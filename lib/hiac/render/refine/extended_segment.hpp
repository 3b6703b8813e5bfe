#pragma once

#include "hiac/frame/frame.hpp"
#include "hiac/render/refine/extended_light.hpp"
#include "hiac/render/refine/extended_tetrahedron.hpp"
#include "hiac/render/tetrahedra/tetrahedron_details.hpp"

namespace hiac {

/// The part of a pixel's ray inside a linear tetrahedron, in extended precision.
struct ExtendedSegment {
  long double front, back;  ///< ray parameters
  ExtendedLight light;
  SegmentDetails details;  ///< with its bounds of errors, in extended precision
};

/// Finds such segments by the engine's method: slices between breakpoints and isosurfaces,
/// closed forms' integrals of each, and the bounds that TetrahedronDetails has of it.
class ExtendedSegments {
 public:
  /// Needs Frame::with_error.
  explicit ExtendedSegments(const Frame& frame) : frame_(frame), details_(frame) {}

  using Met = ExtendedTetrahedron::Met;
  /// The segment of pixel (x, y) in a cell, if there is one to draw. In doubt are cells that the
  /// ray meets more than once or along a face.
  Met find(CellId cell, int x, int y, ExtendedSegment& segment);

 private:
  // One isosurface on one segment.
  struct Cut {
    const FrameIsosurface* surface;
    ExtendedEnds offset;  // where the ray enters and leaves the cell
    std::array<long double, 3> normal;
    long double u;  // where it is crossed, a part of the segment: 2 where it is not
  };
  // What is between two ends.
  struct Stretch {
    long double from, to;      // ray parameters
    long double u_from, u_to;  // parts of the ray inside the cell, not clipped
    long double length;
    std::array<long double, 3> ray;
    ExtendedEnds color, extinction;
  };

  bool clip(const ExtendedTetrahedron::Crossing& crossing, int x, int y, Stretch& stretch) const;
  [[nodiscard]] std::vector<Cut> cuts_of(CellId cell, const ExtendedTetrahedron& tetrahedron,
                                         const ExtendedTetrahedron::Crossing& crossing,
                                         const Stretch& stretch) const;
  [[nodiscard]] ExtendedLight light_of(const Stretch& stretch, const std::vector<Cut>& cuts,
                                       bool empty) const;
  [[nodiscard]] SegmentDetails describe(CellId cell, int x, int y, const Stretch& stretch,
                                        const std::vector<Cut>& cuts, const ExtendedLight& light);

  const Frame& frame_;
  BasicTetrahedronDetails<long double> details_;
};

}  // namespace hiac
