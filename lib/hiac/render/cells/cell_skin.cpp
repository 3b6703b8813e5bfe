#include "hiac/render/cells/cell_skin.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/geometry/extended_vector.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

// The unit vector of a ray, away from the eye: right, up, forward.
std::array<double, 3> ray_through(const Projector& projector, double x, double y) {
  if (!projector.perspective()) return {0, 0, 1};
  const auto [right, up] = projector.slopes(x, y);
  const double length = projector.ray_scale(x, y);
  return {right / length, up / length, 1 / length};
}

// The normal of a plane between two directions in it, in the camera's frame. A face without area
// is seen from no side: any normal does.
std::array<double, 3> normal_between(const Projector& projector, const ExtendedVector& a,
                                     const ExtendedVector& b) {
  const ExtendedVector normal = cross(a, b);
  if (!(length(normal) > 0)) return {0, 0, 1};
  return rounded(projector.extended_camera_vector(unit(normal)));
}

}  // namespace

void CellSkin::enter(CellId cell, const TileRect& tile) {
  cell_ = cell;
  kind_ = frame_.mesh.kinds[cell];
  normals_.fill(std::nullopt);
  nodes_.reset();
  map_.reset();
  field_.reset();
  scanned_.clear();
  crossings_.clear();
  is_met_once_ = true;
  scan_cell(frame_, cell, tile, scanned_);
  const unsigned faces = frame_.skin.on(cell);
  const auto add = [&](const CellCrossing& c, double t, bool enters, std::uint8_t face,
                       const std::array<double, 3>& reference) {
    if ((faces >> face & 1U) == 0) return;
    if (t < frame_.projector.near() || t > frame_.projector.far()) return;
    crossings_.push_back({c.x, c.y, t, enters, face, reference});
  };
  for (std::size_t k = 0; k < scanned_.size(); ++k) {
    const CellCrossing& c = scanned_[k];
    if (k > 0 && scanned_[k - 1].x == c.x && scanned_[k - 1].y == c.y) is_met_once_ = false;
    add(c, c.front, true, c.front_face, c.front_reference);
    add(c, c.back, false, c.back_face, c.back_reference);
  }
}

IsosurfaceShade CellSkin::shade(const SkinCrossing& crossing) {
  const double x = pixel_center(crossing.x), y = pixel_center(crossing.y);
  const bool is_curved = !std::isnan(crossing.reference[0]);
  const auto normal =
      is_curved ? normal_at(crossing.face, crossing.reference) : normal_of(crossing.face);
  SurfaceLook look = frame_.skin.look;
  if (frame_.skin.field) look.color = frame_.skin.colors(value_at(crossing));
  return shade_isosurface(look, frame_.skin.lights, normal, ray_through(frame_.projector, x, y));
}

// Of a planar face: between two edges, or two diagonals.
std::array<double, 3> CellSkin::normal_of(std::size_t face) {
  if (normals_[face]) return *normals_[face];
  const ShapeFace& shape = topology_of(kind_).faces[face];
  const auto ids = frame_.mesh.cell_nodes(cell_);
  const auto at = [&](std::size_t k) -> ExtendedVector {
    const auto p = frame_.mesh.position(ids[shape.corners[k]]);
    return {p[0], p[1], p[2]};
  };
  const bool is_triangle = shape.corner_count == 3;
  normals_[face] = normal_between(frame_.projector, minus(at(is_triangle ? 1 : 2), at(0)),
                                  minus(at(is_triangle ? 2 : 3), at(is_triangle ? 0 : 1)));
  return *normals_[face];
}

// At a point of a curved face: between the images of two directions in the reference cell's face.
std::array<double, 3> CellSkin::normal_at(std::size_t face,
                                          const std::array<double, 3>& reference) {
  const ShapeFace& shape = topology_of(kind_).faces[face];
  const auto corners = reference_nodes(kind_);
  const auto& origin = corners[shape.corners[0]];
  const Vector a = minus(corners[shape.corners[1]], origin),
               b = minus(corners[shape.corners[shape.corner_count - 1U]], origin);
  std::array<Vector, kMaxNodesPerCell> gradients;
  shape_gradients<double>(kind_, reference, gradients);
  ExtendedVector along_a{}, along_b{};
  for (std::size_t k = 0; k < node_count(kind_); ++k) {
    const double by_a = dot(gradients[k], a), by_b = dot(gradients[k], b);
    for (std::size_t c = 0; c < 3; ++c) {
      const double edge = nodes()[k][c] - nodes()[0][c];
      along_a[c] += static_cast<long double>(by_a) * edge;
      along_b[c] += static_cast<long double>(by_b) * edge;
    }
  }
  return normal_between(frame_.projector, along_a, along_b);
}

// The value of the field that decides the colour.
double CellSkin::value_at(const SkinCrossing& crossing) {
  if (!field_) field_ = cell_field(frame_.mesh, cell_, *frame_.skin.field);
  if (field_->least == field_->most && !field_->polynomial) return field_->least;
  const double x = pixel_center(crossing.x), y = pixel_center(crossing.y);
  Vector point = frame_.projector.relative_origin(x, y);
  const Vector direction = frame_.projector.direction(x, y);
  for (std::size_t c = 0; c < 3; ++c) point[c] += crossing.t * direction[c];
  if (field_->polynomial) return field_->polynomial->at(minus(point, nodes()[0]));
  Vector xi = crossing.reference;
  if (std::isnan(xi[0])) {
    if (!map_) map_.emplace(kind_, nodes(), frame_.straightness);
    xi = map_->reference(point, map_->middle());
  }
  std::array<double, kMaxNodesPerCell> shape;
  shape_functions<double>(kind_, xi, shape);
  double value = 0;
  for (std::size_t k = 0; k < node_count(kind_); ++k) value += shape[k] * field_->values[k];
  return std::clamp(value, field_->least, field_->most);
}

const std::array<CellMap::Point, CellMap::kMostNodes>& CellSkin::nodes() {
  if (!nodes_) nodes_ = relative_positions(frame_.mesh, cell_, frame_.projector);
  return *nodes_;
}

}  // namespace hiac
