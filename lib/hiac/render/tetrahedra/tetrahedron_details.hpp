#pragma once

#include <array>
#include <span>
#include <type_traits>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/render/bounds/error_bound.hpp"
#include "hiac/render/pixels/pixel_details.hpp"

namespace hiac {

/// One isosurface on one segment: the offsets from its value where the ray enters and leaves the
/// cell, and whether it is crossed.
struct CutOffsets {
  double front, back;
  bool crossed;
};

/// A segment through a linear tetrahedron, as it was drawn. `Real`: the type with which fields were
/// computed.
template <class Real>
struct BasicTetrahedronSegment {
  int x, y;
  double front, back;  ///< ray parameters
  double length;       ///< world units
  double seen;         ///< upper bound of the integral of its transparency along it
  std::array<Real, 2> color, extinction;  ///< the fields at its front and back
  std::array<double, 3> rgb;
  double transparency;
  double first, mean;                ///< SegmentDetails
  std::span<const CutOffsets> cuts;  ///< of Isosurfaces::in(cell); empty if no surface is near
};

using TetrahedronSegment = BasicTetrahedronSegment<double>;

/// Computes the details of segments through linear tetrahedra, and their error bounds if errors are
/// requested: on the screen for cells of the kernel, in the world for others. `Real`: the type with
/// which segments are computed, double or long double.
template <class Real>
class BasicTetrahedronDetails {
 public:
  using Segment = BasicTetrahedronSegment<Real>;

  explicit BasicTetrahedronDetails(const Frame& frame) : frame_(frame) {}

  void enter(CellId cell);
  [[nodiscard]] SegmentDetails describe(const Segment& segment) const;

 private:
  static constexpr Arithmetic kNumbers = std::is_same_v<Real, double> ? kDoubles : kExtended;
  using Vector = std::array<double, 3>;
  using Ends = typename BasicEndDoubts<Real>::Doubts;
  struct CutErrors {
    const FrameIsosurface* surface;
    Vector normal;   // camera frame
    double angle;    // error of the normal
    double largest;  // largest offset of a corner
    // errors of offsets found on the screen, and in the world
    double offset, world_offset;
  };

  // Returns the corners' values of a field minus `from`, and sets `range` to their range.
  std::array<double, 4> values_of(const FrameField& field, double from, ValueRange& range) const;
  [[nodiscard]] double error_of(const std::array<double, 4>& values, ValueRange range,
                                const RayDisplacement& moved) const;
  [[nodiscard]] Ends end_doubts(const Segment& segment) const;
  [[nodiscard]] ErrorBound cuts_bound(const Segment& segment, const Ends& ends) const;

  const Frame& frame_;
  // of the current cell
  CellId cell_ = 0;
  std::array<Vector, 3> edges_{};  // from corner 0
  BasicEndDoubts<Real> end_doubts_;
  CellOptics optics_;
  RayDisplacement displacement_;
  FieldRounding rounding_ = kTetrahedronRounding;
  double color_error_ = 0, extinction_error_ = 0;
  std::vector<CutErrors> cuts_;
};

using TetrahedronDetails = BasicTetrahedronDetails<double>;

}  // namespace hiac
