#include "hiac/preview/regions/sheets.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/base/special_values.hpp"

namespace hiac::preview {
namespace {

void widen(RayThrough& ray, const SurfacePoint& point) {
  if (point.depth < ray.front.depth) ray.front = point;
  if (point.depth > ray.back.depth) ray.back = point;
}

// The part of the way from a to b at which a point on that line is.
double place_on(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& p) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double share = std::abs(dx) > std::abs(dy) ? (p.x - a.x) / dx : (p.y - a.y) / dy;
  return std::clamp(share, 0.0, 1.0);
}

// The point of a triangle in front of p or behind it; false where p is beside the triangle, or
// where that is seen edge-on.
bool on_triangle(const Polyhedron& polyhedron, std::array<std::uint16_t, 3> corners,
                 const ScreenPoint& p, SurfacePoint& point) {
  const auto& at = polyhedron.points;
  std::array<double, 3> area;
  for (std::size_t k = 0; k < 3; ++k)
    area[k] = twice_area(at[corners[(k + 1) % 3]], at[corners[(k + 2) % 3]], p);
  const auto [least, most] = std::minmax({area[0], area[1], area[2]});
  if (least < 0 && most > 0) return false;
  const double sum = area[0] + area[1] + area[2];
  if (sum == 0) return false;
  point = {0, corners, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    point.weights[k] = area[k] / sum;
    point.depth += point.weights[k] * polyhedron.depths[corners[k]];
  }
  return true;
}

}  // namespace

void Sheets::add_vertices(const Polyhedron& polyhedron, const Subdivision& subdivision) {
  for (std::uint16_t v = 0; v < polyhedron.size(); ++v) {
    const std::uint32_t vertex = subdivision.vertex_of(v);
    if (vertex != Subdivision::kNone)
      widen((*rays_)[vertex], {polyhedron.depths[v], {v, v, v}, {1, 0, 0}});
  }
}

void Sheets::add_edges(const Polyhedron& polyhedron, std::span<const PolyhedronEdge> edges,
                       const Subdivision& subdivision) {
  for (std::size_t n = 0; n < rays_->size(); ++n) {
    RayThrough& ray = (*rays_)[n];
    subdivision.for_edges_at(subdivision.vertices()[n], [&](std::uint32_t e) {
      const auto [a, b] = edges[e];
      if (subdivision.vertex_of(a) == n || subdivision.vertex_of(b) == n) return;
      const double share = place_on(polyhedron.points[a], polyhedron.points[b], ray.at);
      widen(ray, {(1 - share) * polyhedron.depths[a] + share * polyhedron.depths[b],
                  {a, b, b},
                  {1 - share, share, 0}});
    });
  }
}

void Sheets::add_faces(const Polyhedron& polyhedron, const Subdivision& subdivision) {
  on_outline_.assign(rays_->size(), 0);
  for (const std::uint32_t vertex : subdivision.outline()) on_outline_[vertex] = 1;
  for (std::size_t n = 0; n < rays_->size(); ++n) {
    if (on_outline_[n] != 0 || subdivision.vertices()[n].point == Subdivision::kNone) continue;
    for (std::size_t f = 0; f < polyhedron.face_count(); ++f) {
      const auto face = polyhedron.face(f);
      // the faces that meet here are known already
      if (std::ranges::any_of(face, [&](std::uint16_t v) { return subdivision.vertex_of(v) == n; }))
        continue;
      for (std::size_t k = 1; k + 1 < face.size(); ++k) {
        SurfacePoint point;
        if (on_triangle(polyhedron, {face[0], face[k], face[k + 1]}, (*rays_)[n].at, point))
          widen((*rays_)[n], point);
      }
    }
  }
}

void Sheets::find(const Polyhedron& polyhedron, std::span<const PolyhedronEdge> edges,
                  const Subdivision& subdivision, std::vector<RayThrough>& rays) {
  rays_ = &rays;
  rays.clear();
  for (const Subdivision::Vertex& vertex : subdivision.vertices())
    rays.push_back({subdivision.position(vertex),
                    {kInfinity, {0, 0, 0}, {1, 0, 0}},
                    {-kInfinity, {0, 0, 0}, {1, 0, 0}}});
  add_vertices(polyhedron, subdivision);
  add_edges(polyhedron, edges, subdivision);
  add_faces(polyhedron, subdivision);
}

}  // namespace hiac::preview
