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

/// The bound of a pixel's error (the channel "error"): of R, G, B and A, relative to the picture
/// that exact arithmetic would give for the same mesh, order and specification.
///
/// The model, with u = 2^-53 the unit roundoff; docs/accuracy.md says which parts are proven and
/// which are assumed. Its constants exceed the count of operations by at least a third, most of
/// them by a factor of 2; this more than covers the products of two rounding errors, which the
/// count omits; effects that are not small, such as a doubtful optical depth, are taken at their
/// full size.
///
/// - Projection (ray_displacement.hpp): a ray meets a cell as if displaced sideways. Linear
///   tetrahedra are intersected on the screen; there the displacement is at most 2 u of the
///   projected coordinates, which are rounded once from extended precision, plus 20 u of the
///   projected edges, plus 2^-38 pixels if a corner was moved to a pixel's centre by as much
///   (projection.cpp). Entry and exit points may also be off along the ray, by 16 u of the depth
///   times the spread of the cell's depths (perspective interpolates 1/t); this matters as far as
///   fields change along the ray. Other cells are intersected in the world; there the displacement
///   is 24 u times the distance of the cell from the eye (look_at, in parallel views), for curved
///   faces 64, 192 or 512 u of it depending on the order, plus the deviations of edges, faces and
///   maps that count as straight, planar and affine. At entry and exit points of such cells, the
///   displacements of the world and of the screen add up.
///   On shared faces both cells are displaced alike, so that a ray is followed without gap or
///   overlap, although its displacement varies a little from cell to cell.
/// - Fields (field_error): the error of a field is its steepest gradient (gradient_bound.hpp) times
///   that displacement, plus 3 u of its largest value in the cell and 20 u of its range there times
///   the spread (64 u of its largest value where it is interpolated along the ray). It is at most
///   the cell's whole range, and 0 where the field is constant.
/// - Optics (segment_bound): the error of extinction and colour is that of the field times their
///   steepest slopes on the cell's values, plus 8 u of the summands of their evaluation; where they
///   jump, the jump counts on the part of the ray on which the field is within its error of it, if
///   there is one. Add 2e-14 for each piece's weights (linear_piece.hpp), their evaluation and
///   their products, or the bound of the quadrature (polynomial_piece.hpp).
/// - Ends (edge_bound): where a ray enters or leaves a mesh, or fields jump from cell to cell, the
///   displacement moves the ends of the ray's part inside the cell (EndDoubts), and that volume is
///   gained or lost.
/// - Isosurfaces: the field's error over its change along the ray moves a surface through the
///   volume; the normal is wrong by 16 u times the condition of the gradient. The whole surface is
///   in doubt if the field at the entry or exit point equals the surface's value to within its
///   error, but not exactly; so are two surfaces whose positions overlap.
/// - The skin (skin_errors.hpp): it lies at the ends of cells' segments and is off as they are; its
///   normal may be wrong by the deviation of faces that count as planar, on curved faces by the
///   turn of the face over that distance (normal_doubt.hpp); the field that colours it changes over
///   that distance. The whole skin is in doubt where a ray passes an edge or the outline of the
///   skin, or an end of the clipping slab, to within that (skin_outline.hpp); not at an edge of two
///   planar faces seen from one side, where the angle between them counts.
/// - Compositing: every bound is multiplied by the transparency in front of it, and the error of
///   the transparency is tracked as well. Where a ray was terminated early, the remaining
///   transparency times the largest light behind is added.
///
/// The following is by definition, not an error, but for the skin: pixel centres on a projected
/// edge to within rounding (on_crossing, screen_rounding.hpp) lie on the side where the engine puts
/// them; a ray in a face belongs to one of its cells; an edge covers the share of a pixel that is
/// drawn of it, at the place among the cells where it is drawn (skin_painter.hpp).
struct ErrorBound {
  double radiance = 0;      ///< of any channel
  double transparency = 0;  ///< absolute, too
};

/// Bounds of the transfer functions on the values of one cell: largest values, steepest slopes,
/// sums of jumps, rounding of their evaluation, and the number of pieces that a segment may have.
struct CellOptics {
  double tau_most = 0, tau_slope = 0, tau_jump = 0, tau_rounding = 0;
  double color_most = 0, color_slope = 0, color_jump = 0, color_rounding = 0;
  double pieces = 0;
};

CellOptics cell_optics(const OpticsTables& optics, ValueRange color, ValueRange extinction,
                       const Arithmetic& numbers = kDoubles);

/// An upper bound of the length of the gradient of a linear field in a tetrahedron, from the
/// `edges` at its corner 0 and the field's differences along them. Infinite if the volume is 0.
double gradient_length(const std::array<std::array<double, 3>, 3>& edges,
                       const std::array<double, 3>& differences);

/// The relative error of the direction of that gradient, or of any J^-T g, in units of rounding.
double gradient_condition(const std::array<std::array<double, 3>, 3>& columns,
                          const std::array<double, 3>& gradient);

/// The roundings of a field in a cell, as the model counts them.
struct FieldRounding {
  double of_values, of_range;  ///< in units of u
};
inline constexpr FieldRounding kTetrahedronRounding{3, 20}, kAlongRayRounding{64, 0};
/// The error of a field in a cell (see the model); `gradient`: its steepest gradient.
double field_error(ValueRange range, double gradient, const RayDisplacement& moved,
                   const FieldRounding& rounding, const Arithmetic& numbers = kDoubles);

/// The error of one of a segment's fields, and the sum of its transfer function's jumps, each times
/// the length of the segment on which the field is within its error of the jump.
struct FieldDoubt {
  double error = 0, jumped = 0;
};

/// The doubt about a field that is linear along a segment, with values `ends`. `along`: how far the
/// ends are off (RayDisplacement); `error`: that of the field's values. `function`: its transfer
/// function; `jump`, `rounding`: those of the function in the cell (CellOptics).
template <std::size_t N>
FieldDoubt linear_doubt(const TransferTable<N>& function, double jump, double rounding,
                        const std::array<long double, 2>& ends, double length, double along,
                        double error);

/// The largest jump of a transfer function's channels at the lower end of interval k > 0; 0 if it
/// is no more than rounding.
template <std::size_t N>
double jump_at(const TransferTable<N>& function, std::size_t k, double rounding);

/// One segment: its length, an upper bound `seen` of the integral of the transparency along it, and
/// the errors of its fields.
struct SegmentFacts {
  double length = 0, seen = 0;
  FieldDoubt color{}, extinction{};
  double opacity = 0, transparency = 1;  ///< upper bounds
};
ErrorBound segment_bound(const CellOptics& cell, bool emission, const SegmentFacts& segment,
                         const Arithmetic& numbers = kDoubles);

/// A bound of the error of radiance and of transparency due to a doubt of this length about where a
/// segment ends.
double edge_bound(const CellOptics& cell, bool emission, double length);

/// An isosurface that a segment may cross: the segment's `length`, the offsets from the surface's
/// value at both ends, and their errors (0 on a face where the offset vanishes exactly).
struct CutFacts {
  double length = 0;
  double along = 0;  ///< RayDisplacement
  double front = 0, back = 0;
  double front_error = 0, back_error = 0;
  bool crossed = false;
};
/// The error due to one isosurface. `shade`: the error of its shade.
ErrorBound cut_bound(const CellOptics& cell, bool emission, double largest_light,
                     const CutFacts& cut, const ErrorBound& shade);

/// The largest possible error of a segment, whatever is in doubt.
ErrorBound whole_bound(const CellOptics& cell, bool emission, double largest_light, double length);

/// Adds the doubts about the ends of a segment to its error if fields jump from cell to cell;
/// otherwise they matter only where no cell adjoins.
void count_edges_at_jumps(const Frame& frame, SegmentDetails& details);

/// Adds the errors of the surfaces that cross a segment. A surface has `moved`, the error of its
/// ray parameter, and `shade_error`. `doubtful`: there may be other surfaces; `length`: that of the
/// segment; `scale`: world length per unit of the ray parameter; `volume`: the bound of the
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

/// How far the errors of the offsets may move a crossed surface along the ray.
double cut_doubt(const CutFacts& cut);

/// The error of the shade of an isosurface or of the skin if its normal is wrong by `angle`. The
/// vectors are unit vectors in the lights' frame.
ErrorBound shade_bound(const SurfaceLook& surface, std::span<const FrameLight> lights,
                       const std::array<double, 3>& normal, const std::array<double, 3>& ray,
                       double angle, const Arithmetic& numbers = kDoubles);

/// The error bound, for any channel, of a finished pixel or of the part of its ray in front of some
/// point. `transparency`: that of the whole part; `ended`: more may lie behind it; `background`:
/// the largest channel of the background.
double pixel_error(const Frame& frame, const PixelDetails& pixel, double transparency, bool ended,
                   double background);

}  // namespace hiac
