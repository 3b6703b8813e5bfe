#include "hiac/render/bounds/cell_errors.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/element/gradient/gradient_bound.hpp"

namespace hiac {

// Computes the errors of the fields: rounding along the ray, and the allowed error of their
// polynomials.
void CellErrors::enter(CellId cell, std::span<const CellMap::Point> nodes, const CellScalars& color,
                       const CellScalars& extinction, const RayDisplacement& displacement) {
  const CellKind kind = frame_.mesh.kinds[cell];
  const auto range = [](const CellScalars& s) { return ValueRange{s.nodes.least, s.nodes.most}; };
  displacement_ = displacement;
  curved_ = frame_.is_curved(cell);
  optics_ = cell_optics(frame_.optics, range(color), range(extinction));
  end_doubts_ = EndDoubts(kind, nodes);
  const GradientBound gradient(kind, nodes, frame_.straightness);
  const auto difference = [](const CellScalars& s) { return s.nodes.most - s.nodes.least; };
  const auto steepest = [&](const CellScalars& s) {
    return difference(s) == 0 ? 0 : gradient(s.nodes);
  };
  const auto error = [&](const CellScalars& s, double slope) {
    const double allowed = std::isfinite(s.nodes.allowed) ? s.nodes.allowed : difference(s);
    return field_error(range(s), slope, displacement_, kAlongRayRounding) +
           std::min(difference(s), 2 * allowed);
  };
  const double slope = steepest(extinction);
  extinction_ = {&extinction, error(extinction, slope)};
  color_ = {&color, error(color, frame_.optics.same_field ? slope : steepest(color))};
}

// Adds the doubts of the fields about jumps of their transfer functions.
void CellErrors::add_doubts(const RayStretch& stretch, const FieldAlongRay& field, double length,
                            FieldDoubt& color, FieldDoubt& extinction) {
  const OpticsTables& optics = frame_.optics;
  field.along(stretch, pieces_);
  color = polynomial_doubt(optics.color, optics_.color_rounding, *color_.scalars, pieces_,
                           optics.same_field ? 0 : 1, color_.error, length, roots_);
  extinction = polynomial_doubt(optics.extinction, optics_.tau_rounding, *extinction_.scalars,
                                pieces_, 0, extinction_.error, length, roots_);
}

void CellErrors::add(const CellCrossing& crossing, const RayStretch& stretch, double scale,
                     const FieldAlongRay& field, const std::optional<Cut>& cut,
                     SegmentDetails& details) {
  const bool emission = frame_.optics.emission;
  const double length = (stretch.back - stretch.front) * scale;
  FieldDoubt color{color_.error, 0}, extinction{extinction_.error, 0};
  if (optics_.color_jump > 0 || optics_.tau_jump > 0)
    add_doubts(stretch, field, length, color, extinction);
  ErrorBound sum = segment_bound(optics_, emission,
                                 {.length = length,
                                  .seen = length,
                                  .color = color,
                                  .extinction = extinction,
                                  .opacity = 1 - details.transparency,
                                  .transparency = cut ? 1 : details.transparency});
  if (cut)
    add_surfaces(frame_, optics_, cut->surfaces, cut->doubtful, length, scale,
                 details.transparency_error, sum);
  details.radiance_error += sum.radiance;
  details.transparency_error = std::min(1.0, details.transparency_error + sum.transparency);
  add_edges(crossing, stretch, details);
}

// Adds the errors of the points where the ray enters and leaves.
void CellErrors::add_edges(const CellCrossing& crossing, const RayStretch& stretch,
                           SegmentDetails& details) const {
  EndDoubts::Doubts doubts = end_doubts_.at(stretch.origin, stretch.direction, displacement_);
  if (curved_) {
    // the planar faces of a cell with curved faces, each by itself
    doubts.front = end_doubts_.through(crossing.front_face, stretch.direction, displacement_);
    doubts.back = end_doubts_.through(crossing.back_face, stretch.direction, displacement_);
  }
  const auto edge = [&](double planar, double curved_doubt, bool clipped) {
    // the view clips the cell at an exactly known depth
    const double doubt = clipped                    ? displacement_.along
                         : std::isnan(curved_doubt) ? planar
                                                    : curved_doubt + displacement_.along;
    return edge_bound(optics_, frame_.optics.emission, std::min(doubt, longest_));
  };
  details.front_edge = edge(doubts.front, crossing.front_doubt, stretch.front > crossing.front);
  details.back_edge = edge(doubts.back, crossing.back_doubt, stretch.back < crossing.back);
  count_edges_at_jumps(frame_, details);
}

}  // namespace hiac
