#include "hiac/render/ray_displacement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/geometry/inverse_map.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/render/cell_field.hpp"

namespace hiac {
namespace {

constexpr double kUnit = 0x1p-53;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSnapPixels = 0x1p-38;  // projection.cpp, kCenterRounding

// Of a cell's size: what inverse_map.cpp takes for affine (1e-14 at every corner) or lets remain
// of Newton's residual (16 epsilon), each three times.
constexpr double kMapRounding = 3e-14;

Vector middle_of(const ShapeFace& face, std::span<const Vector> corners) {
  Vector middle{};
  for (std::size_t k = 0; k < face.corner_count; ++k)
    for (std::size_t c = 0; c < 3; ++c)
      middle[c] += corners[face.corners[k]][c] / face.corner_count;
  return middle;
}

// Of any length; of quadrilaterals across their diagonals.
Vector normal_of(const ShapeFace& face, std::span<const Vector> corners) {
  const auto edge = [&](std::size_t from, std::size_t to) {
    return minus(corners[face.corners[to]], corners[face.corners[from]]);
  };
  return face.corner_count == 3 ? cross(edge(0, 1), edge(0, 2)) : cross(edge(0, 2), edge(1, 3));
}

// How far a cell is from the polyhedron of its planes and from the image of its map.
double shape_error(CellKind kind, std::span<const Vector> nodes) {
  const auto corners = nodes.first(corner_count(kind));
  double size = 0, bent = 0;
  for (std::size_t k = 1; k < corners.size(); ++k)
    size = std::max(size, length(minus(corners[k], corners[0])));
  for (const ShapeFace& face : topology_of(kind).faces) {
    if (face.corner_count < 4) continue;
    const Vector normal = normal_of(face, corners), middle = middle_of(face, corners);
    const double area = length(normal);
    if (!(area > 0)) continue;
    for (const std::uint8_t k : face.corners)
      bent = std::max(bent, std::abs(dot(normal, minus(corners[k], middle))) / area);
  }
  // four times what a node is off (CellMap::straightened) along every axis
  return 2 * bent + (kMapRounding + 7 * edge_deviation(kind, nodes)) * size;
}

}  // namespace

RayDisplacement ray_displacement(const Frame& frame, CellId cell) {
  const Projector& projector = frame.projector;
  const CellKind kind = frame.mesh.kinds[cell];
  const auto ids = frame.mesh.cell_nodes(cell);
  const auto nodes = relative_positions(frame.mesh, cell, projector);
  const auto [left, top] = projector.slopes(0, 0);
  const double center = std::max(std::abs(left), std::abs(top)) * projector.pixels_per_unit();
  double reach = 0, widest = 0, moved = 0, nearest = kInfinity, farthest = 0;
  const auto at_center = [](double x) { return x - std::floor(x) == 0.5; };
  for (std::size_t k = 0; k < corner_count(kind); ++k) {
    reach = std::max(reach, length(nodes[k]));
    const ProjectedNode& p = frame.nodes[ids[k]];
    if (std::isnan(p.depth)) {
      moved = kSnapPixels;
      nearest = 0;
      continue;
    }
    const double t = projector.parameter(frame.mesh.position(ids[k]));
    nearest = std::min(nearest, t);
    farthest = std::max(farthest, t);
    widest = std::max({widest, std::abs(p.x), std::abs(p.y)});
    if (at_center(p.x) || at_center(p.y)) moved = kSnapPixels;
  }
  RayDisplacement result;
  // cells with corners beside the eye are met in the world, without quotients of depths
  if (projector.perspective() && nearest > 0) result.spread = std::max(1.0, farthest / nearest);
  const double pixels = moved + 16 * kUnit * (widest + center);
  result.aside = result.spread * 32 * kUnit * reach +
                 pixels * (projector.perspective() ? reach : 1) / projector.pixels_per_unit();
  if (kind != CellKind::tetrahedron4)
    result.aside += shape_error(kind, std::span(nodes).first(ids.size()));
  return result;
}

EndDoubts::EndDoubts(CellKind kind, std::span<const Vector> nodes) {
  const auto corners = nodes.first(corner_count(kind));
  Vector inside{};
  for (const Vector& p : corners)
    for (std::size_t c = 0; c < 3; ++c) inside[c] += p[c] / static_cast<double>(corners.size());
  for (const ShapeFace& face : topology_of(kind).faces) {
    Plane& plane = planes_[count_++];
    plane.point = middle_of(face, corners);
    plane.normal = normal_of(face, corners);
    const double area = length(plane.normal);
    if (!(area > 0)) {
      plane.normal = {};
      continue;
    }
    const double sign = dot(plane.normal, minus(inside, plane.point)) < 0 ? -1 : 1;
    for (double& x : plane.normal) x *= sign / area;
  }
}

EndDoubts::Doubts EndDoubts::at(const Vector& origin, const Vector& direction, double aside) const {
  const double scale = length(direction);
  // rounding of the distances below is a part of `aside` itself
  const double doubt = 2 * aside;
  double enter = -kInfinity, leave = kInfinity;
  double enter_least = -kInfinity, enter_most = -kInfinity;
  double leave_least = kInfinity, leave_most = kInfinity;
  for (std::size_t k = 0; k < count_; ++k) {
    const Plane& plane = planes_[k];
    const double inside = dot(plane.normal, minus(origin, plane.point));
    const double cosine = dot(plane.normal, direction) / scale;
    if (std::abs(cosine) <= 8 * kUnit) {
      // seen edge-on: of no consequence but to rays that run along it
      if (inside < doubt) return {kInfinity, kInfinity};
      continue;
    }
    const double at = -inside / cosine, error = doubt / std::abs(cosine);
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
  const auto or_all = [](double x) { return std::isnan(x) ? kInfinity : x; };
  return {or_all(std::max(enter_most - enter, enter - enter_least)),
          or_all(std::max(leave_most - leave, leave - leave_least))};
}

}  // namespace hiac
