#include "hiac/render/tetrahedra/tetrahedron_details.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/base/rounding.hpp"
#include "hiac/element/gradient/gradient_direction.hpp"
#include "hiac/frame/face_value.hpp"
#include "hiac/frame/tiles/tile.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/render/bounds/rounding_counts.hpp"
#include "hiac/render/refine/extended_ray.hpp"

namespace hiac {
namespace {

// Relative to the largest offset: twice the threshold below which tetrahedron_cuts-inl.hpp
// evaluates the face itself.
constexpr double kFoundInWorld = 2 * kOffsetDoubt;

// Rounding of barycentric coordinates in the world, which are quotients of volumes.
constexpr double kBarycentricRounding = 64;

// The cube of the longest edge divided by the volume spanned by the edges from a corner.
double elongation(const std::array<Vector, 3>& edges) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max({longest, length(edges[k]), length(minus(edges[k], edges[(k + 1) % 3]))});
  const double most = longest * longest * longest;
  const double volume = std::abs(dot(edges[0], cross(edges[1], edges[2]))) - 16 * kUnit * most;
  return volume > 0 ? most / volume : std::numeric_limits<double>::infinity();
}

}  // namespace

template <class Real>
std::array<double, 4> BasicTetrahedronDetails<Real>::values_of(const FrameField& field, double from,
                                                               ValueRange& range) const {
  const auto nodes = frame_.mesh.cell_nodes(cell_);
  std::array<double, 4> values;
  for (std::size_t k = 0; k < 4; ++k)
    values[k] = field.values[field.index(cell_, frame_.mesh.elems[cell_] + k, nodes[k])] - from;
  const auto [least, most] = std::ranges::minmax(values);
  range = {least, most};
  return values;
}

template <class Real>
double BasicTetrahedronDetails<Real>::error_of(const std::array<double, 4>& values,
                                               ValueRange range,
                                               const RayDisplacement& moved) const {
  const Vector differences{values[1] - values[0], values[2] - values[0], values[3] - values[0]};
  return field_error(range, gradient_length(edges_, differences), moved, rounding_, kNumbers);
}

template <class Real>
void BasicTetrahedronDetails<Real>::enter(CellId cell) {
  cell_ = cell;
  if (!frame_.with_error) return;
  const auto nodes = frame_.mesh.cell_nodes(cell);
  std::array<std::array<Real, 3>, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto position = frame_.mesh.position(nodes[k]);
    if constexpr (std::is_same_v<Real, double>)
      corners[k] = frame_.projector.relative(position);
    else
      corners[k] = frame_.projector.extended_camera_coordinates(position);
    if (k > 0) edges_[k - 1] = minus(position, frame_.mesh.position(nodes[0]));
  }
  end_doubts_ = BasicEndDoubts<Real>(CellKind::tetrahedron4, corners);
  displacement_ = ray_displacement(frame_, cell, kNumbers);
  rounding_ = kTetrahedronRounding;
  if (frame_.kernel_cells[cell] != CellKernel::linear)
    rounding_.of_range += kBarycentricRounding * elongation(edges_);
  ValueRange color, extinction;
  const auto color_values = values_of(frame_.color_field(), 0, color);
  const auto extinction_values = values_of(frame_.extinction, 0, extinction);
  optics_ = cell_optics(frame_.optics, color, extinction, kNumbers);
  color_error_ = error_of(color_values, color, displacement_);
  extinction_error_ = error_of(extinction_values, extinction, displacement_);
  cuts_.clear();
  if (frame_.isosurfaces.in(cell).empty()) return;
  const RayDisplacement world = displacement_in_world(frame_, cell, kNumbers);
  for (const IsosurfaceCut& in : frame_.isosurfaces.in(cell)) {
    const FrameIsosurface& surface = frame_.isosurfaces.surfaces[in.surface];
    ValueRange range;
    const auto v = values_of(frame_.isosurfaces.fields[surface.field], surface.value, range);
    const Vector differences{v[1] - v[0], v[2] - v[0], v[3] - v[0]};
    cuts_.push_back({&surface,
                     frame_.projector.camera_vector(gradient_direction(edges_, differences)),
                     kAngleRounding * kNumbers.unit * gradient_condition(edges_, differences),
                     std::max(-range.least, range.most), error_of(v, range, displacement_),
                     error_of(v, range, world)});
  }
}

template <class Real>
typename BasicTetrahedronDetails<Real>::Ends BasicTetrahedronDetails<Real>::end_doubts(
    const Segment& segment) const {
  const Projector& projector = frame_.projector;
  Ends doubts;
  if constexpr (std::is_same_v<Real, double>) {
    const double x = pixel_center(segment.x), y = pixel_center(segment.y);
    doubts =
        end_doubts_.at(projector.relative_origin(x, y), projector.direction(x, y), displacement_);
  } else {
    const ExtendedRay ray(projector, segment.x, segment.y);
    doubts = end_doubts_.at(ray.origin, ray.direction, displacement_);
  }
  // the depths of the clipping planes are known exactly
  if (segment.front == frame_.projector.near()) doubts.front = displacement_.along;
  if (segment.back == frame_.projector.far()) doubts.back = displacement_.along;
  return doubts;
}

template <class Real>
ErrorBound BasicTetrahedronDetails<Real>::cuts_bound(const Segment& segment,
                                                     const Ends& ends) const {
  const bool emission = frame_.optics.emission;
  const double largest = frame_.isosurfaces.largest_light;
  Vector ray{0, 0, 1};
  if (frame_.projector.perspective()) {
    const auto [right, up] =
        frame_.projector.slopes(pixel_center(segment.x), pixel_center(segment.y));
    const double unit = 1 / std::sqrt(right * right + up * up + 1);
    ray = {right * unit, up * unit, unit};
  }
  ErrorBound sum;
  const auto facts_of = [&](std::size_t k) {
    const CutOffsets& cut = segment.cuts[k];
    const double steepness =
        segment.length > 0 ? std::abs(cut.front - cut.back) / segment.length : 0;
    // a face that has the value exactly is not in doubt
    const auto doubt = [&](double offset, double end) {
      if (offset == 0) return 0.0;
      // for a ray along a face, the cell's end does not matter
      if (!std::isfinite(end)) end = 0;
      const bool in_world = std::abs(offset) <= kFoundInWorld * cuts_[k].largest;
      return (in_world ? cuts_[k].world_offset : cuts_[k].offset) + steepness * end;
    };
    return CutFacts{.length = segment.length,
                    .along = displacement_.along,
                    .front = cut.front,
                    .back = cut.back,
                    .front_error = doubt(cut.front, ends.front),
                    .back_error = doubt(cut.back, ends.back),
                    .crossed = cut.crossed};
  };
  const auto place = [](const CutFacts& cut) {
    return cut.length * cut.front / (cut.front - cut.back);
  };
  for (std::size_t k = 0; k < segment.cuts.size(); ++k) {
    const CutFacts cut = facts_of(k);
    ErrorBound shade;
    if (cut.crossed)
      shade = shade_bound(*cuts_[k].surface, frame_.isosurfaces.lights, cuts_[k].normal, ray,
                          cuts_[k].angle, kNumbers);
    const ErrorBound bound = cut_bound(optics_, emission, largest, cut, shade);
    sum.radiance += bound.radiance;
    sum.transparency += bound.transparency;
    for (std::size_t j = 0; j < k && cut.crossed; ++j) {
      const CutFacts other = facts_of(j);
      const FrameIsosurface &a = *cuts_[k].surface, &b = *cuts_[j].surface;
      if (!other.crossed || (a.field == b.field && a.value == b.value)) continue;
      // the order of the two surfaces may be in doubt
      if (std::abs(place(cut) - place(other)) <= cut_doubt(cut) + cut_doubt(other))
        sum = whole_bound(optics_, emission, largest, segment.length);
    }
  }
  sum.transparency = std::min(1.0, sum.transparency);
  sum.radiance +=
      sum.transparency * (largest + optics_.color_most * (emission ? segment.length : 1));
  return sum;
}

template <class Real>
SegmentDetails BasicTetrahedronDetails<Real>::describe(const Segment& segment) const {
  SegmentDetails details;
  details.front = segment.front;
  details.back = segment.back;
  details.light = *std::ranges::max_element(segment.rgb);
  details.transparency = segment.transparency;
  details.first = segment.first;
  details.mean = segment.mean;
  if (!frame_.with_error) return details;
  const bool emission = frame_.optics.emission;
  const double along = displacement_.along;
  ErrorBound sum = segment_bound(
      optics_, emission,
      {.length = segment.length,
       .seen = segment.seen,
       .color =
           linear_doubt(frame_.optics.color, optics_.color_jump, optics_.color_rounding,
                        {segment.color[0], segment.color[1]}, segment.length, along, color_error_),
       .extinction = linear_doubt(frame_.optics.extinction, optics_.tau_jump, optics_.tau_rounding,
                                  {segment.extinction[0], segment.extinction[1]}, segment.length,
                                  along, extinction_error_),
       .opacity = 1 - segment.transparency,
       // if surfaces are crossed, the transparency of the volume alone is not known
       .transparency = segment.cuts.empty() ? segment.transparency : 1},
      kNumbers);
  const Ends ends = end_doubts(segment);
  const double most =
      frame_.depth * frame_.projector.ray_scale(pixel_center(segment.x), pixel_center(segment.y));
  details.front_edge = edge_bound(optics_, emission, std::min(most, ends.front));
  details.back_edge = edge_bound(optics_, emission, std::min(most, ends.back));
  if (!segment.cuts.empty()) {
    const ErrorBound cuts = cuts_bound(segment, ends);
    // the error of a part of the volume is seen through the rest
    const double whole =
        optics_.color_most * (emission ? segment.length : 1) + frame_.isosurfaces.largest_light;
    sum.radiance += cuts.radiance + sum.transparency * whole;
    sum.transparency += cuts.transparency;
  }
  details.radiance_error = sum.radiance;
  details.transparency_error = std::min(1.0, sum.transparency);
  count_edges_at_jumps(frame_, details);
  return details;
}

template class BasicTetrahedronDetails<double>;
template class BasicTetrahedronDetails<long double>;

}  // namespace hiac
