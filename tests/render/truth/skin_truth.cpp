#include "tests/render/truth/skin_truth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "hiac/mesh/shape_functions.hpp"
#include "tests/support/extended_vectors.hpp"
#include "tests/support/phong.hpp"

namespace hiac::test {
namespace {

using Real = SkinTruth::Real;

constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

std::vector<NodeId> face_key(const ZooMesh& mesh, CellId cell, const ShapeFace& face) {
  std::vector<NodeId> key;
  for (std::size_t k = 0; k < face.corner_count; ++k)
    key.push_back(mesh.cell_nodes(cell)[face.corners[k]]);
  std::ranges::sort(key);
  return key;
}

// A continuous function, constant beyond its points.
Color color_of(const ColorTransfer& transfer, Real value) {
  const auto& points = transfer.points;
  if (value <= points.front().scalar) return points.front().value;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (value > points[i].scalar) continue;
    const Real s = (value - points[i - 1].scalar) / (points[i].scalar - points[i - 1].scalar);
    Color color;
    for (std::size_t c = 0; c < 3; ++c)
      color[c] = static_cast<double>((1 - s) * points[i - 1].value[c] + s * points[i].value[c]);
    return color;
  }
  return points.back().value;
}

}  // namespace

SkinTruth::SkinTruth(const ZooMesh& mesh, const Scene& scene) : mesh_(mesh), scene_(scene) {
  const Camera& camera = scene.camera;
  const bool perspective = camera.projection == Projection::perspective;
  eye_ = vec(camera.eye);
  forward_ = unit(vec(camera.look_at) - eye_);
  right_ = unit(cross(forward_, vec(camera.up)));
  up_ = cross(right_, forward_);
  const Real extent = perspective ? 2 * std::tan(camera.fov * std::numbers::pi_v<Real> / 360)
                                  : static_cast<Real>(camera.height);
  per_pixel_ = extent / scene.image.height;
  std::map<std::vector<NodeId>, int> cells_of_face;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces)
      ++cells_of_face[face_key(mesh, cell, face)];
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    std::vector<bool> on_skin;
    for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces)
      on_skin.push_back(cells_of_face[face_key(mesh, cell, face)] == 1);
    if (std::ranges::count(on_skin, true) == 0) continue;
    std::vector<Vec> nodes;
    for (const NodeId node : mesh.cell_nodes(cell))
      nodes.push_back(vec(mesh.position(node)) - eye_);
    cells_.push_back({mesh.kinds[cell], CurvedCellTruth(mesh.kinds[cell], nodes), nodes,
                      values_of(cell), on_skin});
  }
}

std::vector<Real> SkinTruth::values_of(CellId cell) const {
  const auto& color_by = scene_.skin->color_by;
  if (!color_by) return {};
  const Field field = scalar_field(mesh_, color_by->field);
  std::vector<Real> values;
  const auto nodes = mesh_.cell_nodes(cell);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    values.push_back(field.location == FieldLocation::node   ? field.values[nodes[k]]
                     : field.location == FieldLocation::cell ? field.values[cell]
                                                             : field.values[mesh_.elems[cell] + k]);
  return values;
}

// The face of the reference cell in whose plane a point lies.
std::size_t SkinTruth::face_at(CellKind kind, const Vec& reference) {
  const auto corners = reference_nodes(kind);
  std::size_t nearest = 0;
  Real least = kInfinity;
  for (std::size_t f = 0; f < face_count(kind); ++f) {
    const auto& on = topology_of(kind).faces[f].corners;
    const Vec origin = vec(corners[on[0]]);
    const Vec normal = unit(cross(vec(corners[on[1]]) - origin, vec(corners[on[2]]) - origin));
    const Real distance = std::abs(dot(normal, reference - origin));
    if (distance < least) nearest = f;
    least = std::min(least, distance);
  }
  return nearest;
}

Isosurface SkinTruth::look_at(const Met& met) const {
  const Skin& skin = *scene_.skin;
  Isosurface look{
      "", 0, skin.color, skin.opacity, skin.ambient, skin.diffuse, skin.specular, skin.shininess};
  if (!skin.color_by) return look;
  std::array<Real, kMaxNodesPerCell> shape;
  shape_functions<Real>(met.cell->kind, met.reference, shape);
  Real value = 0;
  for (std::size_t k = 0; k < met.cell->values.size(); ++k) value += shape[k] * met.cell->values[k];
  look.color = color_of(*skin.color_by, value);
  return look;
}

std::array<Real, 4> SkinTruth::pixel(std::uint32_t x, std::uint32_t y) const {
  const Real a = per_pixel_ * (x + 0.5L - scene_.image.width / 2.0L);
  const Real b = per_pixel_ * (scene_.image.height / 2.0L - y - 0.5L);
  const bool perspective = scene_.camera.projection == Projection::perspective;
  const Vec aside = a * right_ + b * up_;
  const Vec origin = perspective ? Vec{} : aside;
  const Vec direction = perspective ? forward_ + aside : forward_;
  Real from = perspective ? 0 : -kInfinity, to = kInfinity;
  if (scene_.camera.clip) {
    from = std::max<Real>(from, (*scene_.camera.clip)[0]);
    to = (*scene_.camera.clip)[1];
  }
  constexpr Real kUnknown = std::numeric_limits<Real>::quiet_NaN();
  std::vector<Met> all;
  for (const Cell& cell : cells_) {
    const auto crossings = cell.surface.crossings(origin, direction);
    if (crossings.size() % 2 != 0) return {kUnknown, kUnknown, kUnknown, kUnknown};
    for (const auto& crossing : crossings)
      if (const std::size_t face = face_at(cell.kind, crossing.reference); cell.on_skin[face])
        all.push_back({crossing.t, &cell, face, crossing.reference});
  }
  std::ranges::sort(all, {}, &Met::t);
  std::array<Real, 4> rgba{};
  Real transparency = 1, t = from;
  bool inside = false;
  const auto add_medium = [&](Real until) {
    const Real end = std::clamp(until, from, to);
    if (inside && end > t && scene_.volume.extinction) {
      const Real tau = scene_.volume.extinction->points.front().value[0];
      const Real left = std::exp(-tau * (end - t) * norm(direction));
      for (std::size_t c = 0; c < 3; ++c)
        rgba[c] += transparency * (1 - left) * scene_.volume.color->points.front().value[c];
      transparency *= left;
    }
    t = std::max(t, end);
  };
  for (const Met& met : all) {
    add_medium(met.t);
    inside = !inside;
    if (met.t < from || met.t > to) continue;
    const ShapeFace& face = topology_of(met.cell->kind).faces[met.face];
    const auto corners = reference_nodes(met.cell->kind);
    std::array<Vec, kMaxNodesPerCell> gradients;
    shape_gradients<Real>(met.cell->kind, met.reference, gradients);
    const auto along = [&](std::size_t corner) {
      const Vec way = vec(corners[face.corners[corner]]) - vec(corners[face.corners[0]]);
      Vec sum{};
      for (std::size_t k = 0; k < met.cell->nodes.size(); ++k)
        sum = sum + dot(gradients[k], way) * met.cell->nodes[k];
      return sum;
    };
    const auto shade =
        reference_shade(look_at(met), scene_.lights, cross(along(1), along(2)), direction);
    for (std::size_t c = 0; c < 3; ++c) rgba[c] += transparency * shade.rgb[c];
    transparency *= shade.transparency;
  }
  add_medium(kInfinity);
  rgba[3] = 1 - transparency;
  return rgba;
}

}  // namespace hiac::test
