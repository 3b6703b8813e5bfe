#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "hiac/geometry/inverse_map.hpp"
#include "hiac/render/frame.hpp"
#include "hiac/render/pixel_details.hpp"

namespace hiac {

/// The bound of a pixel's error (the channel "error"): of R, G, B and A, against the picture that
/// exact arithmetic would make of the same mesh, order and specification.
///
/// The model, with u = 2^-53 the unit roundoff. It is of first order: products of two rounding
/// errors are left out, and the constants are at least twice what counting operations gives.
///
/// - Projection (displacement): a ray meets a face as if displaced sideways by at most
///   32 u times the distance of the cell from the eye (look_at, in parallel views), plus 16 u times
///   the projected coordinates, and 2^-38 pixels where a corner was moved to a pixel's centre by
///   as much (projection.cpp). On shared faces both cells are displaced alike, so that a ray is
///   followed without gap or overlap, displaced a little differently in every cell.
/// - Fields (FieldError): a field is wrong by its gradient times that, and by 24 u of its largest
///   value in the cell; by the cell's whole range at most.
/// - Optics (segment_bound): what that does to extinction and colour, by their steepest slopes on
///   the cell's values; where they jump, on the stretch of the ray on which the field is in doubt
///   about the jump; 1e-14 for each piece's weights (linear_piece.hpp), their evaluation and their
///   products, or the bound of the quadrature (polynomial_piece.hpp).
/// - Ends (edge_bound): where a ray enters or leaves a mesh, or fields jump from cell to cell, the
///   displacement times the face's slope is volume gained or lost.
/// - Isosurfaces: the field's error over its change along the ray moves a surface through the
///   volume; the normal is wrong by 16 u times the condition of the gradient. A surface is in doubt
///   altogether where the field on the face where the ray enters or leaves the cell is its value to
///   within its error, but not exactly.
/// - Compositing: every bound counts times the transparency in front of it; what becomes of the
///   transparency is followed alongside. Where a ray was ended early, the transparency left times
///   the largest light behind is added.
///
/// By definition, not by error: pixel centres on a projected edge to within rounding (on_crossing,
/// projection.hpp) are on the side where the engine puts them; a ray in a face belongs to one of
/// its cells.
struct ErrorBound {
  double radiance = 0;      ///< of any channel
  double transparency = 0;  ///< absolute, too
};

/// The transfer functions on the values of one cell: largest values, steepest slopes, sums of jumps
/// and, for each cell, how many pieces a segment may have.
struct CellOptics {
  double tau_most = 0, tau_slope = 0, tau_jump = 0;
  double color_most = 0, color_slope = 0, color_jump = 0;
  double pieces = 0;
};

/// No interpolant of `range`, from its least to its greatest value, is steeper than this in a cell
/// of a kind: 16 times the square of the order times the range times CellMap::steepness. In
/// collapsed coordinates a Bernstein polynomial's slope is at most its degree times its range, and
/// where they taper by 1 / w the coefficients at the tip, all equal, leave as much again. The map
/// may be four times as steep elsewhere as in the middle.
double steepest(CellKind kind, const CellMap& map, double range);

/// Values of a field in a cell.
struct ValueRange {
  double least, most;
};
CellOptics cell_optics(const OpticsTables& optics, ValueRange color, ValueRange extinction);

/// How far from its ray a cell may be met sideways, world units.
double displacement(const Frame& frame, CellId cell);

/// Length of the gradient of a linear field in a tetrahedron: `edges` from its corner 0, and the
/// field's differences along them. Infinite without volume.
double gradient_length(const std::array<std::array<double, 3>, 3>& edges,
                       const std::array<double, 3>& differences);

/// Relative error of the direction of that gradient, or of any J^-T g, in units of rounding.
double gradient_condition(const std::array<std::array<double, 3>, 3>& columns,
                          const std::array<double, 3>& gradient);

/// Error of a field in a cell: see the model.
double field_error(ValueRange range, double gradient, double aside);

/// One segment: its length, what the fields are wrong by, and how much they change along it where
/// they are linear (0 where not).
struct SegmentFacts {
  double length = 0;
  double color_error = 0, extinction_error = 0;
  double color_change = 0, extinction_change = 0;
  double opacity = 0, transparency = 1;  ///< not smaller than what they are
};
ErrorBound segment_bound(const CellOptics& cell, bool emission, const SegmentFacts& segment);

/// What a doubt about where a segment ends costs: radiance and transparency, each at most this.
double edge_bound(const CellOptics& cell, bool emission, double length);

/// An isosurface that a segment may cross: `length` of the segment, the offsets from its value at
/// its two ends and their error, and the doubts about faces where offsets vanish exactly.
struct CutFacts {
  double length = 0;
  double front = 0, back = 0;
  double front_error = 0, back_error = 0;
  bool crossed = false;
};
/// `shade`: the error of its shade.
ErrorBound cut_bound(const CellOptics& cell, bool emission, double largest_light,
                     const CutFacts& cut, const ErrorBound& shade);

/// Error of an isosurface's shade for a normal that is wrong by `angle`. Unit vectors in the
/// lights' frame.
ErrorBound shade_bound(const FrameIsosurface& surface, std::span<const FrameLight> lights,
                       const std::array<double, 3>& normal, const std::array<double, 3>& ray,
                       double angle);

/// The bound of a finished pixel, or of what lies in front of a place on its ray: of any channel.
/// `transparency`: of all of it; `background`: the largest channel of what is put behind.
double pixel_error(const Frame& frame, const PixelDetails& pixel, double transparency,
                   double background);

}  // namespace hiac
