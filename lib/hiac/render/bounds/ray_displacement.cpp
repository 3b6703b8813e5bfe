#include "hiac/render/bounds/ray_displacement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/base/rounding.hpp"
#include "hiac/base/special_values.hpp"
#include "hiac/element/cell_field.hpp"
#include "hiac/geometry/extended_vector.hpp"
#include "hiac/geometry/face_form.hpp"
#include "hiac/geometry/inverse_map.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/render/bounds/rounding_counts.hpp"

namespace hiac {
namespace {

template <class Real>
std::array<Real, 3> middle_of(const ShapeFace& face, std::span<const std::array<Real, 3>> corners) {
  std::array<Real, 3> middle{};
  for (std::size_t k = 0; k < face.corner_count; ++k)
    for (std::size_t c = 0; c < 3; ++c)
      middle[c] += corners[face.corners[k]][c] / face.corner_count;
  return middle;
}

// A normal of a face, not normalized; for quadrilaterals the cross product of the diagonals.
template <class Real>
std::array<Real, 3> normal_of(const ShapeFace& face, std::span<const std::array<Real, 3>> corners) {
  const auto edge = [&](std::size_t from, std::size_t to) {
    return minus(corners[face.corners[to]], corners[face.corners[from]]);
  };
  return face.corner_count == 3 ? cross(edge(0, 1), edge(0, 2)) : cross(edge(0, 2), edge(1, 3));
}

// How far the corners of faces that count as planar are off their planes, at most.
double bent(const Frame& frame, CellId cell, std::span<const Vector> corners) {
  double most = 0;
  const auto faces = topology_of(frame.mesh.kinds[cell]).faces;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (faces[f].corner_count < 4 || face_form(frame.mesh, cell, f, frame.straightness).curved)
      continue;
    const Vector normal = normal_of<double>(faces[f], corners),
                 middle = middle_of<double>(faces[f], corners);
    const double area = length(normal);
    if (!(area > 0)) continue;
    for (const std::uint8_t k : faces[f].corners)
      most = std::max(most, std::abs(dot(normal, minus(corners[k], middle))) / area);
  }
  return most;
}

double size_of(std::span<const Vector> points) {
  double size = 0;
  for (const Vector& p : points) size = std::max(size, length(minus(p, points[0])));
  return size;
}

// How far a cell's map is from the map by which the fields are sampled.
double map_error(const CellMap& map, CellKind kind, std::span<const Vector> nodes) {
  if (!map.straight()) return kMapRounding * kUnit * size_of(nodes);
  const double size = size_of(nodes.first(corner_count(kind)));
  // four times the deviation of a node (CellMap::straightened) along every axis
  return (kMapRounding * kUnit + 7 * edge_deviation(kind, nodes)) * size + 2 * map.off_affine();
}

// A bound of how far edges and faces of a curved cell that count as straight and planar may be off:
// four times the deviation of their nodes. Straightness is decided face by face; the bound takes
// the largest deviation of all nodes within the limit, which is no smaller.
double straightened(CellKind kind, std::span<const Vector> nodes, double straightness) {
  const auto reference = reference_nodes(kind);
  const std::size_t corners = corner_count(kind);
  const double doubtful = 2 * straightness * size_of(nodes);
  double most = 0;
  std::array<double, kMaxNodesPerCell> shape;
  for (std::size_t k = corners; k < node_count(kind); ++k) {
    shape_functions<double>(kind_of(shape_of(kind), CellOrder::linear), reference[k], shape);
    Vector off = nodes[k];
    for (std::size_t n = 0; n < corners; ++n)
      for (std::size_t c = 0; c < 3; ++c) off[c] -= shape[n] * nodes[n][c];
    if (length(off) <= doubtful) most = std::max(most, length(off));
  }
  return 4 * most;
}

// The displacement of the faces of a cell, found from its projected corners. Corners beside the eye
// have no projection: such cells are intersected in the world.
RayDisplacement displacement_on_screen(const Frame& frame, CellId cell, const Arithmetic& numbers) {
  const Projector& projector = frame.projector;
  const auto ids = frame.mesh.cell_nodes(cell).first(corner_count(frame.mesh.kinds[cell]));
  double reach = 0, widest = 0, moved = 0, nearest = kInfinity, farthest = 0;
  double left = kInfinity, right = -kInfinity, top = kInfinity, bottom = -kInfinity;
  const auto at_center = [](double x) { return x - std::floor(x) == 0.5; };
  bool beside = false;
  for (const NodeId id : ids) {
    const ProjectedNode& p = frame.nodes[id];
    reach = std::max(reach, length(projector.relative(frame.mesh.position(id))));
    beside = beside || std::isnan(p.depth);
    nearest = std::min(nearest, -1 / p.depth);
    farthest = std::max(farthest, -1 / p.depth);
    widest = std::max({widest, std::abs(p.x), std::abs(p.y)});
    left = std::min(left, p.x);
    right = std::max(right, p.x);
    top = std::min(top, p.y);
    bottom = std::max(bottom, p.y);
    if (!std::isnan(p.depth) && (at_center(p.x) || at_center(p.y))) moved = numbers.snap;
  }
  double pixels = moved;
  if (!beside)
    pixels += numbers.unit * (kCoordinateRounding * widest +
                              kPlaceRounding * std::max(right - left, bottom - top));
  RayDisplacement result;
  if (projector.perspective() && !beside) result.spread = farthest / nearest;
  result.aside = 32 * kExtendedUnit * reach +
                 pixels * (projector.perspective() ? reach : 1) / projector.pixels_per_unit();
  result.at_ends = result.aside;
  result.along = kDepthRounding * numbers.unit * result.spread * reach;
  return result;
}

}  // namespace

RayDisplacement displacement_in_world(const Frame& frame, CellId cell, const Arithmetic& numbers) {
  const CellKind kind = frame.mesh.kinds[cell];
  const auto nodes = relative_positions(frame.mesh, cell, frame.projector);
  const std::span all = std::span(nodes).first(node_count(kind));
  const auto corners = all.first(corner_count(kind));
  double reach = 0;
  for (const Vector& p : corners) reach = std::max(reach, length(p));
  const RayDisplacement screen = displacement_on_screen(frame, cell, numbers);
  RayDisplacement result;
  result.aside = kWorldRounding * numbers.unit * reach;
  if (kind != CellKind::tetrahedron4)
    result.aside += 2 * bent(frame, cell, corners) +
                    map_error(CellMap(kind, all, frame.straightness), kind, all);
  result.at_ends = result.aside + screen.aside;
  result.along = screen.along;
  if (!frame.is_curved(cell)) return result;
  for (const Vector& p : all) reach = std::max(reach, length(p));
  // screen coordinates are relative to the corner of the screen
  const Projector& projector = frame.projector;
  const Projector::Axes axes = projector.axes();
  const double border = std::max(axes.center_x, axes.center_y) / projector.pixels_per_unit();
  const double rounding = kCurvedRounding[static_cast<std::size_t>(order_of(kind)) - 1] * kUnit *
                          (reach + (projector.perspective() ? reach : 1) * border);
  result.aside += rounding;
  result.at_ends += rounding + straightened(kind, all, frame.straightness);
  result.along = std::max(result.along, rounding);
  return result;
}

RayDisplacement ray_displacement(const Frame& frame, CellId cell, const Arithmetic& numbers) {
  return frame.kernel_cells[cell] == CellKernel::linear
             ? displacement_on_screen(frame, cell, numbers)
             : displacement_in_world(frame, cell, numbers);
}

template <class Real>
BasicEndDoubts<Real>::BasicEndDoubts(CellKind kind, std::span<const Vector> nodes) {
  const auto corners = nodes.first(corner_count(kind));
  Vector inside{};
  for (const Vector& p : corners) reach_ = std::max(reach_, length(p));
  for (const Vector& p : corners)
    for (std::size_t c = 0; c < 3; ++c) inside[c] += p[c] / static_cast<Real>(corners.size());
  for (const ShapeFace& face : topology_of(kind).faces) {
    Plane& plane = planes_[count_++];
    plane.point = middle_of<Real>(face, corners);
    plane.normal = normal_of<Real>(face, corners);
    const Real area = length(plane.normal);
    if (!(area > 0)) {
      plane.normal = {};
      continue;
    }
    const Real sign = dot(plane.normal, minus(inside, plane.point)) < 0 ? -1 : 1;
    for (Real& x : plane.normal) x *= sign / area;
  }
}

template <class Real>
typename BasicEndDoubts<Real>::Doubts BasicEndDoubts<Real>::at(const Vector& origin,
                                                               const Vector& direction,
                                                               const RayDisplacement& moved) const {
  constexpr Real kRounding = 16 * kUnitOf<Real>;
  constexpr Real kNever = std::numeric_limits<Real>::infinity();
  const Real scale = length(direction);
  // plus the rounding of the distances below
  const Real doubt = 2 * static_cast<Real>(moved.at_ends) + kRounding * reach_;
  Real enter = -kNever, leave = kNever;
  Real enter_least = -kNever, enter_most = -kNever;
  Real leave_least = kNever, leave_most = kNever;
  for (std::size_t k = 0; k < count_; ++k) {
    const Plane& plane = planes_[k];
    const Real inside = dot(plane.normal, minus(origin, plane.point));
    const Real cosine = dot(plane.normal, direction) / scale;
    if (std::abs(cosine) <= kRounding) {
      // seen edge-on: matters only to rays that run along it
      if (inside < doubt) return {kInfinity, kInfinity};
      continue;
    }
    const Real at = -inside / cosine, error = doubt / std::abs(cosine);
    if (cosine > 0) {
      enter = std::max(enter, at);
      enter_least = std::max(enter_least, at - error);
      enter_most = std::max(enter_most, at + error);
    } else {
      leave = std::min(leave, at);
      leave_least = std::min(leave_least, at - error);
      leave_most = std::min(leave_most, at + error);
    }
  }
  const auto or_all = [](Real x) { return std::isnan(x) ? kInfinity : static_cast<double>(x); };
  return {or_all(std::max(enter_most - enter, enter - enter_least)) + moved.along,
          or_all(std::max(leave_most - leave, leave - leave_least)) + moved.along};
}

template <class Real>
double BasicEndDoubts<Real>::through(std::size_t face, const Vector& direction,
                                     const RayDisplacement& moved) const {
  constexpr Real kRounding = 16 * kUnitOf<Real>;
  const Real cosine = std::abs(dot(planes_[face].normal, direction)) / length(direction);
  const Real doubt = 2 * static_cast<Real>(moved.at_ends) + kRounding * reach_;
  return cosine > kRounding ? static_cast<double>(doubt / cosine) + moved.along : kInfinity;
}

template class BasicEndDoubts<double>;
template class BasicEndDoubts<long double>;

}  // namespace hiac
