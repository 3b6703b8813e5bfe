#include "hiac/render/cells/cell_skin.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/base/special_values.hpp"
#include "hiac/geometry/extended_vector.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {

void CellSkin::enter(CellId cell, const TileRect& tile, const PixelMask* only) {
  cell_ = cell;
  normals_.fill(std::nullopt);
  shape_.reset();
  map_.reset();
  field_.reset();
  scanned_.clear();
  crossings_.clear();
  is_met_once_ = true;
  scan_cell(frame_, cell, tile, scanned_, only);
  const unsigned faces = frame_.skin.on(cell);
  const auto add = [&](const CellCrossing& c, double t, bool enters, std::uint8_t face,
                       const std::array<double, 3>& reference, double doubt) {
    if ((faces >> face & 1U) == 0) return;
    if (t < frame_.projector.near() || t > frame_.projector.far()) return;
    crossings_.push_back({c.x, c.y, t, enters, face, reference, doubt});
  };
  for (std::size_t k = 0; k < scanned_.size(); ++k) {
    const CellCrossing& c = scanned_[k];
    if (k > 0 && scanned_[k - 1].x == c.x && scanned_[k - 1].y == c.y) is_met_once_ = false;
    add(c, c.front, true, c.front_face, c.front_reference, c.front_doubt);
    add(c, c.back, false, c.back_face, c.back_reference, c.back_doubt);
  }
}

bool CellSkin::is_one_side(std::size_t face, const std::array<double, 3>& from,
                           const std::array<double, 3>& to, int x, int y) {
  return hiac::is_one_side(frame_.projector, shape(), face, from, to, x, y);
}

std::span<const ShadedPoint> CellSkin::shade(std::span<const std::uint32_t> which,
                                             std::span<const double> ray_scales) {
  const FrameSkin& skin = frame_.skin;
  shaded_.resize(which.size());
  for (std::size_t k = 0; k < which.size(); ++k) {
    const SkinCrossing& crossing = crossings_[which[k]];
    const bool is_curved = !std::isnan(crossing.reference[0]);
    ShadedPoint& point = shaded_[k];
    point.normal = is_curved
                       ? normal_at(frame_.projector, shape(), crossing.face, crossing.reference)
                       : normal_of(crossing.face);
    point.ray = ray_through(frame_.projector, pixel_center(crossing.x), pixel_center(crossing.y),
                            ray_scales[k]);
    point.color = skin.field ? skin.colors(value_at(crossing)) : skin.look.color;
  }
  shade_points(skin.look, skin.lights, shaded_);
  return shaded_;
}

// Of a planar face: between two edges, or two diagonals.
std::array<double, 3> CellSkin::normal_of(std::size_t face) {
  if (normals_[face]) return *normals_[face];
  const ShapeFace& form = topology_of(frame_.mesh.kinds[cell_]).faces[face];
  const auto ids = frame_.mesh.cell_nodes(cell_);
  const auto at = [&](std::size_t k) -> ExtendedVector {
    const auto p = frame_.mesh.position(ids[form.corners[k]]);
    return {p[0], p[1], p[2]};
  };
  const bool is_triangle = form.corner_count == 3;
  normals_[face] = normal_between(frame_.projector, minus(at(is_triangle ? 1 : 2), at(0)),
                                  minus(at(is_triangle ? 2 : 3), at(is_triangle ? 0 : 1)));
  return *normals_[face];
}

double CellSkin::value_at(const SkinCrossing& crossing) {
  if (!field_) field_ = cell_field(frame_.mesh, cell_, *frame_.skin.field);
  if (field_->least == field_->most && !field_->polynomial) return field_->least;
  const double x = pixel_center(crossing.x), y = pixel_center(crossing.y);
  Vector point = frame_.projector.relative_origin(x, y);
  const Vector direction = frame_.projector.direction(x, y);
  for (std::size_t c = 0; c < 3; ++c) point[c] += crossing.t * direction[c];
  if (field_->polynomial) return field_->polynomial->at(minus(point, shape().nodes[0]));
  Vector xi = crossing.reference;
  if (std::isnan(xi[0])) {
    if (!map_) map_.emplace(shape().kind, shape().nodes, frame_.straightness);
    xi = map_->reference(point, map_->middle());
  }
  std::array<double, kMaxNodesPerCell> weights;
  shape_functions<double>(shape().kind, xi, weights);
  double value = 0;
  for (std::size_t k = 0; k < node_count(shape().kind); ++k)
    value += weights[k] * field_->values[k];
  return std::clamp(value, field_->least, field_->most);
}

const MappedCell& CellSkin::shape() {
  if (!shape_)
    shape_ = MappedCell{frame_.mesh.kinds[cell_],
                        relative_positions(frame_.mesh, cell_, frame_.projector)};
  return *shape_;
}

}  // namespace hiac
