#include "hiac/render/refine/extended_cell_segment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "hiac/element/face_interpolant.hpp"
#include "hiac/element/gradient/gradient_bound.hpp"
#include "hiac/element/ray_rounding.hpp"
#include "hiac/optics/polynomial_piece.hpp"
#include "hiac/render/bounds/rounding_counts.hpp"
#include "hiac/render/cells/cuts_along_ray.hpp"
#include "hiac/render/cells/sign_changes.hpp"

namespace hiac {
namespace {

using Real = long double;
using Vec = ExtendedVector;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Shares of the tolerance: a sixteenth of those of general_cells.cpp.
constexpr double kFieldShare = 0x1p-12, kIntegrationShare = 0x1p-11;

// Whether an isosurface's field is below its value where the ray crosses a face.
bool below_at_face(const IsosurfaceCut& cut, CellKind kind, std::size_t face,
                   std::span<const NodeId> nodes, std::span<const double> offsets, Real offset) {
  if ((cut.closed_faces & (1U << face)) != 0) return true;
  bool mixed = false;
  const double sign = face_offsets(kind, face, nodes, offsets).sign(mixed);
  return mixed ? offset < 0 : sign < 0;
}

}  // namespace

std::array<double, 8> ExtendedCellSegments::node_values(const FrameField& field) const {
  const auto nodes = frame_.mesh.cell_nodes(cell_);
  std::array<double, 8> values{};
  for (std::size_t k = 0; k < nodes.size(); ++k)
    values[k] = field.values[field.index(cell_, frame_.mesh.elems[cell_] + k, nodes[k])];
  return values;
}

// The field minus `level`, and its errors; `nodes`: the same in doubles.
ExtendedCellSegments::Known ExtendedCellSegments::known(const CellField& nodes,
                                                        const FrameField& field,
                                                        double level) const {
  const std::array<double, 8> values = node_values(field);
  const std::size_t count = frame_.mesh.cell_nodes(cell_).size();
  Known known{};
  for (std::size_t k = 0; k < count; ++k)
    known.field.values[k] = static_cast<Real>(values[k]) - level;
  const auto [least, most] = std::ranges::minmax(std::span(known.field.values).first(count));
  known.field.least = least;
  known.field.most = most;
  if (least == most) return known;
  const ValueRange range{nodes.least, nodes.most};
  const double difference = range.most - range.least;
  const double largest = std::max(std::abs(range.least), std::abs(range.most));
  const double rounding = kExtended.unit * (kRayValueRounding * largest +
                                            kRayPointRounding * reach_ * steepness_ * difference);
  const double negligible = std::max(nodes.allowed, rounding);
  known.field.negligible = negligible;
  const double gradient = (*gradient_)(nodes);
  known.error = field_error(range, gradient, inside_, kAlongRayRounding, kExtended) +
                std::min(difference, 2 * negligible);
  if (bent_ > 0) known.at_faces = std::min(difference, gradient * 2 * bent_);
  return known;
}

void ExtendedCellSegments::load(CellId cell, const ExtendedCell& geometry, const ExtendedRay& ray) {
  cell_ = cell;
  const OpticsTables& optics = frame_.optics;
  const CellKind kind = frame_.mesh.kinds[cell];
  extinction_ = cell_scalars(frame_.mesh, cell, frame_.extinction, optics.extinction);
  color_ =
      optics.same_field ? extinction_ : cell_scalars(frame_.mesh, cell, frame_.color, optics.color);
  set_allowed_errors(frame_, frame_.depth * static_cast<double>(ray.scale),
                     kFieldShare * frame_.tolerance, color_, extinction_);
  const auto nodes = relative_positions(frame_.mesh, cell, frame_.projector);
  gradient_.emplace(kind, nodes, frame_.straightness);
  steepness_ = CellMap(kind, nodes, frame_.straightness).steepness();
  reach_ = geometry.reach();
  bent_ = geometry.bent();
  inside_ = {};
  inside_.aside = kExtended.unit * (kWorldRounding * reach_ + kMapRounding * geometry.size());
  inside_.at_ends = inside_.aside + bent_;
  inside_.along = kPlaneDepthRounding * kExtended.unit * reach_;
  known_extinction_ = known(extinction_.nodes, frame_.extinction, 0);
  known_color_ =
      optics.same_field ? known_extinction_ : known(color_.nodes, frame_.color_field(), 0);
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
                                Stretch& stretch) const {
  const ExtendedCell::Part part = geometry.inside(ray);
  stretch.front = part.front;
  stretch.back = part.back;
  stretch.front_face = part.front_face;
  stretch.back_face = part.back_face;
  const BasicEndDoubts<Real> doubts(frame_.mesh.kinds[cell_], geometry.corners());
  stretch.doubts = doubts.at(ray.origin, ray.direction, inside_);
  const Projector& projector = frame_.projector;
  stretch.front_clipped = stretch.front < projector.extended_near();
  stretch.back_clipped = stretch.back > projector.extended_far();
  if (stretch.front_clipped) {
    stretch.front = projector.extended_near();
    stretch.doubts.front = inside_.along;
  }
  if (stretch.back_clipped) {
    stretch.back = projector.extended_far();
    stretch.doubts.back = inside_.along;
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

// Fills places_ with the positions, as fractions of the stretch, at which pieces_ change sign, and
// `moved` with the error of each.
void ExtendedCellSegments::find_places(const IsosurfaceCut& cut, const CellField& offsets,
                                       const Known& known, const Stretch& stretch,
                                       std::vector<Real>& moved) {
  const CellKind kind = frame_.mesh.kinds[cell_];
  const auto nodes = frame_.mesh.cell_nodes(cell_);
  const auto below = [&](std::uint8_t face, Real offset) {
    return below_at_face(cut, kind, face, nodes, offsets.values, offset);
  };
  places_.clear();
  std::optional<bool> first;
  if (!stretch.front_clipped)
    first = below(stretch.front_face, pieces_.empty() ? 0 : evaluate(pieces_.front().fields[0], 0));
  SignChanges<Real> changes(first, places_);
  for (const ExtendedCell::Piece& piece : pieces_)
    changes.follow(piece.fields[0], piece.begin, piece.end, known.field.negligible, roots_);
  if (!stretch.back_clipped)
    changes.certain(
        below(stretch.back_face, pieces_.empty() ? 0 : evaluate(pieces_.back().fields[0], 1)), 1,
        1);
  moved.assign(places_.size(), 0);
  if (pieces_.empty() && known.field.least < known.field.most) doubtful_ = true;
  // whether the number of places stays the same if offsets are off by `error`, and how far they
  // move
  const Real error = known.error + 2 * known.field.negligible;
  std::vector<Real> none, shifted;
  bool as_many = as_many_when_shifted(pieces_, error, places_, moved, shifted, roots_);
  if (known.at_faces > 0)
    as_many &=
        as_many_when_shifted(pieces_, error + known.at_faces, places_, none, shifted, roots_);
  if (!as_many) doubtful_ = true;
}

bool ExtendedCellSegments::add_surface(const ExtendedCell& geometry, const ExtendedRay& ray,
                                       const Stretch& stretch, const IsosurfaceCut& cut) {
  const FrameIsosurface& surface = frame_.isosurfaces.surfaces[cut.surface];
  const FrameField& field = frame_.isosurfaces.fields[surface.field];
  const CellField offsets = cell_field(frame_.mesh, cell_, field, surface.value);
  const Known offset = known(offsets, field, surface.value);
  pieces_.clear();
  if (stretch.front < stretch.back &&
      !geometry.along(ray, stretch.front, stretch.back, {&offset.field, 1}, pieces_))
    return false;
  std::vector<Real> moved;
  find_places(cut, offsets, offset, stretch, moved);
  const Real depth = stretch.back - stretch.front;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Crossed crossed{&surface,
                    stretch.front + places_[i] * depth,
                    static_cast<double>(moved[i] * depth),
                    {},
                    {}};
    if (!shade(geometry, ray, stretch, offset, crossed)) return false;
    crossed_.push_back(crossed);
  }
  return true;
}

// Shades a crossing with the normal there; the error of the shade includes the normal's change over
// the interval in which the crossing may lie. Returns false if a point's reference coordinates are
// not found.
bool ExtendedCellSegments::shade(const ExtendedCell& geometry, const ExtendedRay& ray,
                                 const Stretch& stretch, const Known& known,
                                 Crossed& crossed) const {
  const auto normal_at = [&](Real t, Vec& normal, double& rounding) {
    ExtendedCell::Derivatives d;
    if (!geometry.derivatives(ray.at(t), known.field.values, d)) return false;
    normal = {};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec area = cross(d.columns[(k + 1) % 3], d.columns[(k + 2) % 3]);
      for (std::size_t c = 0; c < 3; ++c) normal[c] += d.gradient[k] * area[c];
    }
    normal = length(normal) > 0 ? unit(normal) : Vec{0, 0, 1};
    rounding =
        kAngleRounding * kExtended.unit *
        gradient_condition({rounded(d.columns[0]), rounded(d.columns[1]), rounded(d.columns[2])},
                           rounded(d.gradient));
    return true;
  };
  Vec normal;
  double angle = 0;
  if (!normal_at(crossed.t, normal, angle)) return false;
  const Real reach = crossed.moved + inside_.aside;
  for (const Real t :
       {std::max(stretch.front, crossed.t - reach), std::min(stretch.back, crossed.t + reach)}) {
    Vec other;
    double other_angle = 0;
    if (!normal_at(t, other, other_angle)) return false;
    const Vec opposite{-other[0], -other[1], -other[2]};
    const Real apart = std::min(length(minus(other, normal)), length(minus(opposite, normal)));
    angle = std::max(angle, other_angle) + 2 * static_cast<double>(apart);
  }
  const Vec along = ray.along();
  const auto& lights = frame_.isosurfaces.lights;
  crossed.light = extended_surface(*crossed.surface, lights, normal, along);
  crossed.shade_error =
      shade_bound(*crossed.surface, lights, rounded(normal), rounded(along), angle, kExtended);
  return true;
}

bool ExtendedCellSegments::find_surfaces(const ExtendedCell& geometry, const ExtendedRay& ray,
                                         const Stretch& stretch) {
  crossed_.clear();
  doubtful_ = false;
  for (const IsosurfaceCut& cut : frame_.isosurfaces.in(cell_))
    if (!add_surface(geometry, ray, stretch, cut)) return false;
  std::ranges::stable_sort(crossed_, {}, &Crossed::t);
  if (order_doubtful(crossed_)) doubtful_ = true;
  return true;
}

// Adds to `doubt` that near the entry and exit points the field may be that of the neighbours.
// `slope`, `jump`: those of its transfer function in the cell.
FieldDoubt ExtendedCellSegments::with_ends(FieldDoubt doubt, const Known& known, double slope,
                                           double jump, const Stretch& stretch) const {
  if (known.at_faces > 0)
    doubt.jumped += (slope * known.at_faces + jump) *
                    std::min(stretch.length, stretch.doubts.front + stretch.doubts.back);
  return doubt;
}

// False where places are not found.
bool ExtendedCellSegments::describe(const ExtendedCell& geometry, const ExtendedRay& ray,
                                    const Stretch& stretch, const Part& sum,
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
    add_surfaces(frame_, optics_, crossed_, doubtful_, stretch.length,
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
  Stretch stretch{};
  if (!clip(geometry, ray, stretch)) return Met::no;
  if (!find_surfaces(geometry, ray, stretch)) return Met::doubtful;
  Part sum;
  Real from = stretch.front;
  for (const Crossed& surface : crossed_) {
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
