#include "hiac/render/refine/extended_segment.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hiac/element/face_interpolant.hpp"
#include "hiac/frame/interval_range.hpp"
#include "hiac/geometry/extended_vector.hpp"
#include "hiac/render/refine/extended_ray.hpp"

namespace hiac {
namespace {

using Real = long double;
using Vec = ExtendedVector;

// The values of a field at a tetrahedron's corners.
CornerValues values_of(const Frame& frame, const FrameField& field, CellId cell,
                       const std::array<std::size_t, 4>& corners) {
  const auto nodes = frame.mesh.cell_nodes(cell);
  CornerValues values;
  for (std::size_t k = 0; k < 4; ++k)
    values[k] =
        field.values[field.index(cell, frame.mesh.elems[cell] + corners[k], nodes[corners[k]])];
  return values;
}

// The range of intervals of its transfer function that a field reaches in a tetrahedron.
IntervalRange intervals_of(const Frame& frame, const FrameField& field, CellId cell) {
  const auto nodes = frame.mesh.cell_nodes(cell);
  IntervalRange range{~std::size_t{0}, 0};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t at = field.index(cell, frame.mesh.elems[cell] + k, nodes[k]);
    range.low = std::min<std::size_t>(range.low, field.intervals[at].low);
    range.high = std::max<std::size_t>(range.high, field.intervals[at].high);
  }
  return range;
}

// The direction of the gradient of a linear scalar, camera frame.
Vec normal_of(const Frame& frame, CellId cell, const std::array<std::size_t, 4>& corners,
              const CornerValues& values) {
  const auto nodes = frame.mesh.cell_nodes(cell);
  std::array<Vec, 3> edge;
  const auto base = frame.mesh.position(nodes[corners[0]]);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto p = frame.mesh.position(nodes[corners[k + 1]]);
    for (std::size_t c = 0; c < 3; ++c) edge[k][c] = static_cast<Real>(p[c]) - base[c];
  }
  Vec n{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec area = cross(edge[(k + 1) % 3], edge[(k + 2) % 3]);
    for (std::size_t c = 0; c < 3; ++c) n[c] += (values[k + 1] - values[0]) * area[c];
  }
  // shading does not depend on its side
  if (!(length(n) > 0)) return {0, 0, 1};
  return frame.projector.extended_camera_vector(unit(n));
}

// The offset at the point where the ray enters or leaves by a face, clamped to the sign of the
// whole face if that has one.
Real offset_on(const Frame& frame, CellId cell, const IsosurfaceCut& cut,
               const ExtendedTetrahedron& cell_met, const ExtendedTetrahedron::Place& place,
               const CornerValues& offsets) {
  const auto nodes = frame.mesh.cell_nodes(cell);
  const auto& corners = cell_met.corners();
  FaceOffsets face;
  for (std::size_t k = 0; k < 4; ++k)
    if (k != place.face) face.add(nodes[corners[k]], static_cast<double>(offsets[k]));
  if ((cut.closed_faces & (1U << tetrahedron_face_without(corners[place.face]))) != 0)
    return kJustBelow;
  bool mixed = false;
  const double sign = face.sign(mixed);
  const Real offset = cell_met.at(place, offsets);
  if (mixed) return offset;
  return sign < 0 ? std::min<Real>(offset, kJustBelow) : std::max<Real>(offset, 0);
}

}  // namespace

bool ExtendedSegments::clip(const ExtendedTetrahedron::Crossing& crossing, int x, int y,
                            Stretch& stretch) const {
  const Projector& projector = frame_.projector;
  const Real front = crossing.front.t, back = crossing.back.t;
  stretch.from = std::max(front, projector.extended_near());
  stretch.to = std::min(back, projector.extended_far());
  if (stretch.from > stretch.to || (stretch.from == stretch.to && front < back)) return false;
  stretch.u_from = stretch.from == front ? 0 : (stretch.from - front) / (back - front);
  stretch.u_to = stretch.to == back ? 1 : (stretch.to - front) / (back - front);
  const ExtendedRay ray(projector, x, y);
  stretch.ray = ray.along();
  stretch.length = (stretch.to - stretch.from) * ray.scale;  // section 5.1: the slanted distance
  return true;
}

std::vector<ExtendedSegments::Cut> ExtendedSegments::cuts_of(
    CellId cell, const ExtendedTetrahedron& tetrahedron,
    const ExtendedTetrahedron::Crossing& crossing, const Stretch& stretch) const {
  std::vector<Cut> cuts;
  for (const IsosurfaceCut& cut : frame_.isosurfaces.in(cell)) {
    const FrameIsosurface& surface = frame_.isosurfaces.surfaces[cut.surface];
    CornerValues offsets =
        values_of(frame_, frame_.isosurfaces.fields[surface.field], cell, tetrahedron.corners());
    for (Real& offset : offsets) offset -= surface.value;
    const ExtendedEnds offset{offset_on(frame_, cell, cut, tetrahedron, crossing.front, offsets),
                              offset_on(frame_, cell, cut, tetrahedron, crossing.back, offsets)};
    Real u = 2;
    if ((offset.front >= 0) != (offset.back >= 0)) {
      u = std::min<Real>(offset.front / (offset.front - offset.back), 1);
      if (u < stretch.u_from || u > stretch.u_to)
        u = 2;
      else if (stretch.u_to > stretch.u_from)
        u = (u - stretch.u_from) / (stretch.u_to - stretch.u_from);
    }
    cuts.push_back({&surface, offset, normal_of(frame_, cell, tetrahedron.corners(), offsets), u});
  }
  return cuts;
}

ExtendedLight ExtendedSegments::light_of(const Stretch& stretch, const std::vector<Cut>& cuts,
                                         bool empty) const {
  std::vector<const Cut*> crossed;
  for (const Cut& cut : cuts)
    if (cut.u <= 1) crossed.push_back(&cut);
  std::ranges::stable_sort(crossed, {}, [](const Cut* cut) { return cut->u; });
  ExtendedLight light;
  Real u = 0;
  const auto add_volume = [&](Real until) {
    if (!empty && u < until)
      light.add_behind(extended_volume(frame_.optics, (until - u) * stretch.length,
                                       {stretch.color.at(u), stretch.color.at(until)},
                                       {stretch.extinction.at(u), stretch.extinction.at(until)}));
    u = until;
  };
  for (const Cut* cut : crossed) {
    add_volume(cut->u);
    light.add_behind(
        extended_surface(*cut->surface, frame_.isosurfaces.lights, cut->normal, stretch.ray));
  }
  add_volume(1);
  return light;
}

SegmentDetails ExtendedSegments::describe(CellId cell, int x, int y, const Stretch& stretch,
                                          const std::vector<Cut>& cuts,
                                          const ExtendedLight& light) {
  std::vector<CutOffsets> offsets;
  for (const Cut& cut : cuts)
    offsets.push_back(
        {static_cast<double>(cut.offset.front), static_cast<double>(cut.offset.back), cut.u <= 1});
  BasicTetrahedronSegment<Real> drawn{
      .x = x,
      .y = y,
      .front = static_cast<double>(stretch.from),
      .back = static_cast<double>(stretch.to),
      .length = static_cast<double>(stretch.length),
      .seen = cuts.empty() ? static_cast<double>(light.seen) : static_cast<double>(stretch.length),
      .color = {stretch.color.front, stretch.color.back},
      .extinction = {stretch.extinction.front, stretch.extinction.back},
      .rgb = {},
      .transparency = static_cast<double>(light.transparency),
      .first = static_cast<double>(stretch.from),
      .mean = static_cast<double>(stretch.from),
      .cuts = offsets};
  for (std::size_t c = 0; c < 3; ++c) drawn.rgb[c] = static_cast<double>(light.rgb[c]);
  details_.enter(cell);
  return details_.describe(drawn);
}

ExtendedSegments::Met ExtendedSegments::find(CellId cell, int x, int y, ExtendedSegment& segment) {
  const bool surfaces = !frame_.isosurfaces.in(cell).empty();
  const bool empty = is_empty_space(frame_.optics, intervals_of(frame_, frame_.color_field(), cell),
                                    intervals_of(frame_, frame_.extinction, cell));
  if (empty && !surfaces) return Met::no;
  const ExtendedTetrahedron tetrahedron(frame_, cell);
  ExtendedTetrahedron::Crossing crossing;
  const Met met = tetrahedron.cross(x, y, crossing);
  Stretch stretch;
  if (met != Met::once) return met;
  if (!clip(crossing, x, y, stretch)) return Met::no;
  const auto ends_of = [&](const FrameField& field) {
    const CornerValues values = values_of(frame_, field, cell, tetrahedron.corners());
    const ExtendedEnds whole{tetrahedron.at(crossing.front, values),
                             tetrahedron.at(crossing.back, values)};
    return ExtendedEnds{whole.at(stretch.u_from), whole.at(stretch.u_to)};
  };
  stretch.extinction = ends_of(frame_.extinction);
  stretch.color = frame_.optics.same_field ? stretch.extinction : ends_of(frame_.color);
  const std::vector<Cut> cuts = cuts_of(cell, tetrahedron, crossing, stretch);
  segment.front = stretch.from;
  segment.back = stretch.to;
  segment.light = light_of(stretch, cuts, empty);
  segment.details = describe(cell, x, y, stretch, cuts, segment.light);
  return Met::once;
}

}  // namespace hiac
