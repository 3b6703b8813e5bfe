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
  SegmentDetails details;  ///< with the error bounds of extended precision
};

/// Finds such segments by the engine's method: slices between breakpoints and isosurfaces,
/// closed-form integrals of each slice, and the bounds of TetrahedronDetails.
class ExtendedSegments {
 public:
  /// Needs Frame::with_error.
  explicit ExtendedSegments(const Frame& frame) : frame_(frame), details_(frame) {}

  using Met = ExtendedTetrahedron::Met;
  /// Finds the segment of pixel (x, y) in a cell, if there is one to draw. The result is doubtful
  /// if the ray meets the cell more than once or along a face.
  Met find(CellId cell, int x, int y, ExtendedSegment& segment);

 private:
  // One isosurface on one segment.
  struct Cut {
    const FrameIsosurface* surface;
    ExtendedEnds offset;  // at the entry and exit points of the cell
    std::array<long double, 3> normal;
    long double u;  // position of the crossing, as a fraction of the segment; 2 if none
  };
  // A part of a ray and its fields.
  struct Stretch {
    long double from, to;      // ray parameters
    long double u_from, u_to;  // fractions of the unclipped ray inside the cell
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
