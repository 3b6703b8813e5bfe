#include "hiac/render/refine/extended_cell_segment.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "hiac/optics/polynomial_piece.hpp"

namespace hiac {
namespace {

using Real = long double;

// Shares of the tolerance: a sixteenth of those of general_cells.cpp.
constexpr double kFieldShare = 0x1p-12, kIntegrationShare = 0x1p-11;

}  // namespace

void ExtendedCellSegments::load(CellId cell, const ExtendedCell& geometry, const ExtendedRay& ray) {
  cell_ = cell;
  const OpticsTables& optics = frame_.optics;
  extinction_ = cell_scalars(frame_.mesh, cell, frame_.extinction, optics.extinction);
  color_ =
      optics.same_field ? extinction_ : cell_scalars(frame_.mesh, cell, frame_.color, optics.color);
  set_allowed_errors(frame_, frame_.depth * static_cast<double>(ray.scale),
                     kFieldShare * frame_.tolerance, color_, extinction_);
  fields_.enter(cell, geometry);
  known_extinction_ = fields_.known(extinction_.nodes, frame_.extinction, 0);
  known_color_ =
      optics.same_field ? known_extinction_ : fields_.known(color_.nodes, frame_.color_field(), 0);
  const auto range = [](const CellScalars& s) { return ValueRange{s.nodes.least, s.nodes.most}; };
  optics_ = cell_optics(optics, range(color_), range(extinction_), kExtended);
}

// Whether the ray of pixel (x, y) meets the cell exactly once according to the engine.
ExtendedCellSegments::Met ExtendedCellSegments::meet(CellId cell, int x, int y) {
  crossings_.clear();
  scan_cell(frame_, cell, {x, y, x + 1, y + 1}, crossings_);
  if (crossings_.empty()) return Met::no;
  return crossings_.size() > 1 || frame_.is_curved(cell) ? Met::doubtful : Met::once;
}

// Clips the ray to the cell and the view. Returns false if nothing remains.
bool ExtendedCellSegments::clip(const ExtendedCell& geometry, const ExtendedRay& ray,
                                ExtendedStretch& stretch) const {
  const ExtendedCell::Part part = geometry.inside(ray);
  stretch.front = part.front;
  stretch.back = part.back;
  stretch.front_face = part.front_face;
  stretch.back_face = part.back_face;
  const BasicEndDoubts<Real> doubts(frame_.mesh.kinds[cell_], geometry.corners());
  stretch.doubts = doubts.at(ray.origin, ray.direction, fields_.inside());
  const Projector& projector = frame_.projector;
  stretch.front_clipped = stretch.front < projector.extended_near();
  stretch.back_clipped = stretch.back > projector.extended_far();
  if (stretch.front_clipped) {
    stretch.front = projector.extended_near();
    stretch.doubts.front = fields_.inside().along;
  }
  if (stretch.back_clipped) {
    stretch.back = projector.extended_far();
    stretch.doubts.back = fields_.inside().along;
  }
  stretch.length = static_cast<double>((stretch.back - stretch.front) * ray.scale);
  const bool cut = !frame_.isosurfaces.in(cell_).empty();
  return cut ? stretch.front <= stretch.back : stretch.front < stretch.back;
}

// False where places are not found.
bool ExtendedCellSegments::find_fields(const ExtendedCell& geometry, const ExtendedRay& ray,
                                       Real front, Real back) {
  const std::array<Field, 2> fields{known_extinction_.field, known_color_.field};
  return geometry.along(ray, front, back, std::span(fields).first(frame_.optics.same_field ? 1 : 2),
                        pieces_);
}

// Adds the light of the volume between two ray parameters behind `sum`. Returns false if a point's
// reference coordinates are not found.
bool ExtendedCellSegments::add_volume(const ExtendedCell& geometry, const ExtendedRay& ray,
                                      Real front, Real back, Part& sum) {
  if (empty_ || !(front < back)) return true;
  if (!find_fields(geometry, ray, front, back)) return false;
  const OpticsTables& optics = frame_.optics;
  const double allowed =
      kIntegrationShare * frame_.tolerance * (static_cast<double>(back - front) / frame_.depth);
  for (const ExtendedCell::Piece& piece : pieces_) {
    const Real share = piece.end - piece.begin;
    const auto radiance = integrate_segment(
        BasicPolynomialSegment<Real>{piece.fields[optics.same_field ? 0 : 1], piece.fields[0],
                                     share * (back - front) * ray.scale},
        optics.color_function, optics.extinction_function,
        optics.emission ? Glow::emission : Glow::chromaticity,
        std::max(static_cast<double>(share) * allowed, std::numeric_limits<double>::min()));
    const auto before = static_cast<double>(sum.light.transparency);
    sum.quadrature.radiance +=
        before * radiance.error +
        sum.quadrature.transparency * static_cast<double>(std::ranges::max(radiance.rgb));
    sum.quadrature.transparency += before * radiance.transparency_error;
    sum.light.add_behind({radiance.rgb, radiance.transparency});
  }
  return true;
}

// Adds to `doubt` that near the entry and exit points the field may be that of the neighbours.
// `slope`, `jump`: those of its transfer function in the cell.
FieldDoubt ExtendedCellSegments::with_ends(FieldDoubt doubt, const ExtendedCellField& known,
                                           double slope, double jump,
                                           const ExtendedStretch& stretch) const {
  if (known.at_faces > 0)
    doubt.jumped += (slope * known.at_faces + jump) *
                    std::min(stretch.length, stretch.doubts.front + stretch.doubts.back);
  return doubt;
}

// False where places are not found.
bool ExtendedCellSegments::describe(const ExtendedCell& geometry, const ExtendedRay& ray,
                                    const ExtendedStretch& stretch, const Part& sum,
                                    SegmentDetails& details) {
  const OpticsTables& optics = frame_.optics;
  const bool emission = optics.emission, cut = !frame_.isosurfaces.in(cell_).empty();
  details.front = details.first = static_cast<double>(stretch.front);
  details.back = static_cast<double>(stretch.back);
  details.mean = (details.front + details.back) / 2;
  details.light = static_cast<double>(std::ranges::max(sum.light.rgb));
  details.transparency = static_cast<double>(sum.light.transparency);
  FieldDoubt color{known_color_.error, 0}, extinction{known_extinction_.error, 0};
  if (optics_.color_jump > 0 || optics_.tau_jump > 0) {
    if (!find_fields(geometry, ray, stretch.front, stretch.back)) return false;
    color = polynomial_doubt(optics.color, optics_.color_rounding, color_, pieces_,
                             optics.same_field ? 0 : 1, known_color_.error, stretch.length, roots_);
    extinction = polynomial_doubt(optics.extinction, optics_.tau_rounding, extinction_, pieces_, 0,
                                  known_extinction_.error, stretch.length, roots_);
  }
  const double opacity = 1 - details.transparency;
  ErrorBound bound = segment_bound(
      optics_, emission,
      {.length = stretch.length,
       .seen = stretch.length,
       .color = with_ends(color, known_color_, optics_.color_slope, optics_.color_jump, stretch),
       .extinction =
           with_ends(extinction, known_extinction_, optics_.tau_slope, optics_.tau_jump, stretch),
       .opacity = opacity,
       .transparency = cut ? 1 : details.transparency},
      kExtended);
  if (cut)
    add_surfaces(frame_, optics_, surfaces_.crossed(), surfaces_.doubtful(), stretch.length,
                 static_cast<double>(ray.scale), sum.quadrature.transparency, bound);
  details.radiance_error = sum.quadrature.radiance + bound.radiance;
  details.transparency_error = std::min(1.0, sum.quadrature.transparency + bound.transparency);
  const double most = frame_.depth * static_cast<double>(ray.scale);
  details.front_edge = edge_bound(optics_, emission, std::min(most, stretch.doubts.front));
  details.back_edge = edge_bound(optics_, emission, std::min(most, stretch.doubts.back));
  count_edges_at_jumps(frame_, details);
  return true;
}

ExtendedCellSegments::Met ExtendedCellSegments::find(CellId cell, int x, int y,
                                                     ExtendedSegment& segment) {
  const Met met = meet(cell, x, y);
  if (met != Met::once) return met;
  const ExtendedRay ray(frame_.projector, x, y);
  const ExtendedCell geometry(frame_, cell);
  load(cell, geometry, ray);
  empty_ = is_empty_space(frame_.optics, color_.intervals, extinction_.intervals);
  if (empty_ && frame_.isosurfaces.in(cell).empty()) return Met::no;
  ExtendedStretch stretch{};
  if (!clip(geometry, ray, stretch)) return Met::no;
  if (!surfaces_.find(geometry, ray, stretch)) return Met::doubtful;
  Part sum;
  Real from = stretch.front;
  for (const ExtendedCrossing& surface : surfaces_.crossed()) {
    if (!add_volume(geometry, ray, from, surface.t, sum)) return Met::doubtful;
    sum.light.add_behind(surface.light);
    from = std::max(from, surface.t);
  }
  if (!add_volume(geometry, ray, from, stretch.back, sum) ||
      !describe(geometry, ray, stretch, sum, segment.details))
    return Met::doubtful;
  segment.front = stretch.front;
  segment.back = stretch.back;
  segment.light = sum.light;
  return Met::once;
}

}  // namespace hiac
