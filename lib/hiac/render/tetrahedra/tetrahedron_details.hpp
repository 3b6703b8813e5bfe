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

/// A segment through a linear tetrahedron, as it was drawn. `Real`: what fields were computed with.
template <class Real>
struct BasicTetrahedronSegment {
  int x, y;
  double front, back;  ///< ray parameters
  double length;       ///< world units
  double seen;         ///< not less than the integral of its transparency along it
  std::array<Real, 2> color, extinction;  ///< the fields where it begins and ends
  std::array<double, 3> rgb;
  double transparency;
  double first, mean;                ///< SegmentDetails
  std::span<const CutOffsets> cuts;  ///< of Isosurfaces::in(cell), or none where none is near
};

using TetrahedronSegment = BasicTetrahedronSegment<double>;

/// Details of segments through linear tetrahedra; where errors are asked for, with their bounds:
/// found over the screen those of the kernel's cells, others in the world. `Real`: what the
/// segments are computed with, double or long double.
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
    double angle;    // that it is wrong by
    double largest;  // offset of a corner
    // that offsets are wrong by: found over the screen, or in the world
    double offset, world_offset;
  };

  // Corners' values of a field less `from`, and the range of the values themselves.
  std::array<double, 4> values_of(const FrameField& field, double from, ValueRange& range) const;
  [[nodiscard]] double error_of(const std::array<double, 4>& values, ValueRange range,
                                const RayDisplacement& moved) const;
  [[nodiscard]] Ends end_doubts(const Segment& segment) const;
  [[nodiscard]] ErrorBound cuts_bound(const Segment& segment, const Ends& ends) const;

  const Frame& frame_;
  // of the cell at hand
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
