#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "hiac/frame/frame.hpp"
#include "hiac/mesh/interpolant_range.hpp"
#include "hiac/render/bounds/arithmetic.hpp"
#include "hiac/render/bounds/ray_displacement.hpp"
#include "hiac/render/pixels/pixel_details.hpp"

namespace hiac {

/// The bound of a pixel's error (the channel "error"): of R, G, B and A, against the picture that
/// exact arithmetic would make of the same mesh, order and specification.
///
/// The model, with u = 2^-53 the unit roundoff; docs/accuracy.md says what of it is proven and
/// what assumed. Its constants are at least a third more than counting operations gives, most of
/// them twice as much, which is more than enough for the products of two rounding errors that the
/// count leaves out; effects that are not small, such as a doubtful optical depth, are taken at
/// their full size.
///
/// - Projection (ray_displacement.hpp): a ray meets a cell as if displaced sideways. Linear
///   tetrahedra are met over the screen: by at most 2 u of their projected coordinates, which are
///   rounded once from extended precision, 20 u of their projected edges, and 2^-38 pixels where a
///   corner was moved to a pixel's centre by as much (projection.cpp); along the ray besides, where
///   they are entered and left, by 16 u of the depth times the spread of the cell's depths
///   (perspective interpolates 1/t), which counts as far as fields change along the ray. Other
///   cells are met in the world: by 24 u times the distance of the cell from the eye (look_at, in
///   parallel views), curved faces by 64, 192 or 512 u of it by order, and what edges, faces and
///   maps are off that count as straight, planar and affine; where they are entered and left, by
///   both.
///   On shared faces both cells are displaced alike, so that a ray is followed without gap or
///   overlap, displaced a little differently in every cell.
/// - Fields (field_error): a field is wrong by its steepest gradient (gradient_bound.hpp) times
///   that, and by 3 u of its largest value in the cell and 20 u of its range there times the spread
///   (64 u of its largest value where it is interpolated along the ray); by the cell's whole range
///   at most; not at all where it is constant.
/// - Optics (segment_bound): what that does to extinction and colour, by their steepest slopes on
///   the cell's values, and 8 u of all that their evaluation adds up; where they jump, on the
///   stretch of the ray on which the field is in doubt about the jump, if there is one; 2e-14 for
///   each piece's weights (linear_piece.hpp), their evaluation and their products, or the bound of
///   the quadrature (polynomial_piece.hpp).
/// - Ends (edge_bound): where a ray enters or leaves a mesh, or fields jump from cell to cell, what
///   the displacement moves the ends of its part inside the cell by (EndDoubts) is volume gained or
///   lost.
/// - Isosurfaces: the field's error over its change along the ray moves a surface through the
///   volume; the normal is wrong by 16 u times the condition of the gradient. A surface is in doubt
///   altogether where the field on the face where the ray enters or leaves the cell is its value to
///   within its error, but not exactly; so are two surfaces whose places overlap.
/// - Compositing: every bound counts times the transparency in front of it; what becomes of the
///   transparency is followed alongside. Where a ray was ended early, the transparency left times
///   the largest light behind is added.
///
/// By definition, not by error: pixel centres on a projected edge to within rounding (on_crossing,
/// screen_rounding.hpp) are on the side where the engine puts them; a ray in a face belongs to one
/// of its cells.
struct ErrorBound {
  double radiance = 0;      ///< of any channel
  double transparency = 0;  ///< absolute, too
};

/// The transfer functions on the values of one cell: largest values, steepest slopes, sums of
/// jumps, rounding of their evaluation and, for each cell, how many pieces a segment may have.
struct CellOptics {
  double tau_most = 0, tau_slope = 0, tau_jump = 0, tau_rounding = 0;
  double color_most = 0, color_slope = 0, color_jump = 0, color_rounding = 0;
  double pieces = 0;
};

CellOptics cell_optics(const OpticsTables& optics, ValueRange color, ValueRange extinction,
                       const Arithmetic& numbers = kDoubles);

/// Length of the gradient of a linear field in a tetrahedron, not too small: `edges` from its
/// corner 0, and the field's differences along them. Infinite without volume.
double gradient_length(const std::array<std::array<double, 3>, 3>& edges,
                       const std::array<double, 3>& differences);

/// Relative error of the direction of that gradient, or of any J^-T g, in units of rounding.
double gradient_condition(const std::array<std::array<double, 3>, 3>& columns,
                          const std::array<double, 3>& gradient);

/// Error of a field in a cell: see the model. `rounding`: of the largest value, in units of u.
struct FieldRounding {
  double of_values, of_range;  ///< in units of u
};
inline constexpr FieldRounding kTetrahedronRounding{3, 20}, kAlongRayRounding{64, 0};
double field_error(ValueRange range, double gradient, const RayDisplacement& moved,
                   const FieldRounding& rounding, const Arithmetic& numbers = kDoubles);

/// What one of a segment's fields is wrong by; and where its transfer function jumps, by how much,
/// times the length of the segment on which the field is in doubt about it, in sum.
struct FieldDoubt {
  double error = 0, jumped = 0;
};

/// Of a field that is linear along a segment, with these values at its ends, which are off by
/// `along` (RayDisplacement) in places and the field by `error` in values. `function`: its transfer
/// function, with `jump` and `rounding` as it has them in the cell (CellOptics).
template <std::size_t N>
FieldDoubt linear_doubt(const TransferTable<N>& function, double jump, double rounding,
                        const std::array<long double, 2>& ends, double length, double along,
                        double error);

/// What a transfer function jumps by at the lower end of interval k > 0, any channel; 0 where that
/// is no more than rounding.
template <std::size_t N>
double jump_at(const TransferTable<N>& function, std::size_t k, double rounding);

/// One segment: its length, how much of it is seen from its front (not less than the integral of
/// the transparency in front along it), and what is wrong with its fields.
struct SegmentFacts {
  double length = 0, seen = 0;
  FieldDoubt color{}, extinction{};
  double opacity = 0, transparency = 1;  ///< not smaller than what they are
};
ErrorBound segment_bound(const CellOptics& cell, bool emission, const SegmentFacts& segment,
                         const Arithmetic& numbers = kDoubles);

/// What a doubt about where a segment ends costs: radiance and transparency, each at most this.
double edge_bound(const CellOptics& cell, bool emission, double length);

/// An isosurface that a segment may cross: `length` of the segment, the offsets from its value at
/// its two ends and their error, and the doubts about faces where offsets vanish exactly.
struct CutFacts {
  double length = 0;
  double along = 0;  ///< RayDisplacement
  double front = 0, back = 0;
  double front_error = 0, back_error = 0;
  bool crossed = false;
};
/// `shade`: the error of its shade.
ErrorBound cut_bound(const CellOptics& cell, bool emission, double largest_light,
                     const CutFacts& cut, const ErrorBound& shade);

/// What a segment may be wrong by at most, whatever it is in doubt about.
ErrorBound whole_bound(const CellOptics& cell, bool emission, double largest_light, double length);

/// Counts what the ends of a segment are in doubt about at once, where fields jump from cell to
/// cell; else it counts where nothing adjoins.
void count_edges_at_jumps(const Frame& frame, SegmentDetails& details);

/// Adds what surfaces that cross a segment are wrong by. A surface has `moved`, what its ray
/// parameter may be wrong by, and `shade_error`. `doubtful`: there may be other surfaces; `length`:
/// of the segment; `scale`: world length per unit of the ray parameter; `volume`: the bound of the
/// transparency of the volume between them.
template <class Surfaces>
void add_surfaces(const Frame& frame, const CellOptics& cell, const Surfaces& surfaces,
                  bool doubtful, double length, double scale, double volume, ErrorBound& sum) {
  const bool emission = frame.optics.emission;
  const double largest = frame.isosurfaces.largest_light;
  const ErrorBound whole = whole_bound(cell, emission, largest, length);
  for (const auto& surface : surfaces) {
    const double moved = edge_bound(cell, emission, surface.moved * scale);
    sum.radiance += surface.shade_error.radiance + moved * (1 + largest);
    sum.transparency += surface.shade_error.transparency;
  }
  if (doubtful) sum = whole;
  sum.radiance += (sum.transparency + volume) * whole.radiance;
}

/// How far along the ray the doubts about offsets move a surface that is crossed.
double cut_doubt(const CutFacts& cut);

/// Error of an isosurface's shade for a normal that is wrong by `angle`. Unit vectors in the
/// lights' frame.
ErrorBound shade_bound(const FrameIsosurface& surface, std::span<const FrameLight> lights,
                       const std::array<double, 3>& normal, const std::array<double, 3>& ray,
                       double angle, const Arithmetic& numbers = kDoubles);

/// The bound of a finished pixel, or of what lies in front of a place on its ray: of any channel.
/// `transparency`: of all of it; `ended`: there may be more behind; `background`: the largest
/// channel of what is put behind.
double pixel_error(const Frame& frame, const PixelDetails& pixel, double transparency, bool ended,
                   double background);

}  // namespace hiac
