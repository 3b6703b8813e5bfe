#include "hiac/frame/projection.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "hiac/base/large_pages.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/frame/screen_rounding.hpp"
#include "hiac/frame/tiles/tile.hpp"
#include "hiac/geometry/extended_vector.hpp"
#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

// Beyond this many pixels from the centre a projected coordinate has lost too many digits to be
// scan converted (an ulp is then 3e-11 pixels); such nodes, close to the eye plane, count as not
// projectable, and their cells are intersected with rays in world space.
constexpr double kFarthestPixel = 131072;

double at_center(long double extended) {
  const auto coordinate = static_cast<double>(extended);
  const double center = pixel_center(std::floor(coordinate));
  return std::abs(coordinate - center) <= kSnapToCenter ? center : coordinate;
}

using Extended = ExtendedVector;

Extended difference(std::span<const double, 3> a, const Vector& b) {
  return {static_cast<long double>(a[0]) - b[0], static_cast<long double>(a[1]) - b[1],
          static_cast<long double>(a[2]) - b[2]};
}

}  // namespace

Projector::Projector(const Camera& camera, ImageSize size)
    : perspective_(camera.projection == Projection::perspective),
      size_(size),
      anchor_(perspective_ ? camera.eye : camera.look_at),
      extended_forward_(unit(difference(camera.look_at, camera.eye))),
      center_x_(size.width / 2.0 + camera.shift[0]),
      center_y_(size.height / 2.0 + camera.shift[1]),
      near_(perspective_ ? 0 : -std::numeric_limits<double>::infinity()),
      far_(std::numeric_limits<double>::infinity()),
      extended_near_(near_),
      extended_far_(far_) {
  extended_right_ = unit(cross(extended_forward_, {camera.up[0], camera.up[1], camera.up[2]}));
  extended_up_ = cross(extended_right_, extended_forward_);
  const long double half = size.height / 2.0L;
  extended_scale_ = perspective_
                        ? half / std::tan(camera.fov * (std::numbers::pi_v<long double> / 360))
                        : size.height / static_cast<long double>(camera.height);
  right_ = rounded(extended_right_);
  up_ = rounded(extended_up_);
  forward_ = rounded(extended_forward_);
  scale_ = static_cast<double>(extended_scale_);
  const Extended to_eye = difference(camera.look_at, camera.eye);
  const long double away = perspective_ ? 0 : std::hypot(to_eye[0], to_eye[1], to_eye[2]);
  offset_ = static_cast<double>(away);
  if (camera.clip) {
    extended_near_ = (*camera.clip)[0] - away;
    extended_far_ = (*camera.clip)[1] - away;
    near_ = static_cast<double>(extended_near_);
    far_ = static_cast<double>(extended_far_);
  }
}

Vector Projector::camera_vector(const Vector& v) const {
  return {dot(v, right_), dot(v, up_), dot(v, forward_)};
}

Vector Projector::camera_coordinates(std::span<const double, 3> point) const {
  return camera_vector(minus(point, anchor_));
}

std::array<long double, 3> Projector::project_extended(std::span<const double, 3> point) const {
  const auto [c0, c1, c2] = extended_camera_coordinates(point);
  if (!perspective_)
    return {center_x_ + extended_scale_ * c0, center_y_ - extended_scale_ * c1, c2};
  const long double reciprocal = 1 / c2;
  return {center_x_ + extended_scale_ * (c0 * reciprocal),
          center_y_ - extended_scale_ * (c1 * reciprocal), -reciprocal};
}

bool Projector::project(std::span<const double, 3> point, ProjectedNode& node) const {
  const auto [x, y, depth] = project_extended(point);
  node = {at_center(x), at_center(y), static_cast<double>(depth)};
  return !perspective_ || (depth < 0 && std::abs(x - center_x_) < kFarthestPixel &&
                           std::abs(y - center_y_) < kFarthestPixel);
}

Extended Projector::extended_camera_coordinates(std::span<const double, 3> point) const {
  return extended_camera_vector(difference(point, anchor_));
}

Extended Projector::extended_camera_vector(const Extended& v) const {
  return {dot(v, extended_right_), dot(v, extended_up_), dot(v, extended_forward_)};
}

std::array<long double, 2> Projector::extended_slopes(double x, double y) const {
  return {(x - center_x_) / extended_scale_, (center_y_ - y) / extended_scale_};
}

double Projector::parameter(std::span<const double, 3> point) const {
  return dot(minus(point, anchor_), forward_);
}

Vector Projector::origin(double x, double y) const {
  const Vector r = relative_origin(x, y);
  return {anchor_[0] + r[0], anchor_[1] + r[1], anchor_[2] + r[2]};
}

Vector Projector::relative(std::span<const double, 3> point) const { return minus(point, anchor_); }

Vector Projector::relative_origin(double x, double y) const {
  if (perspective_) return {0, 0, 0};
  const double a = (x - center_x_) / scale_, b = (center_y_ - y) / scale_;
  return {a * right_[0] + b * up_[0], a * right_[1] + b * up_[1], a * right_[2] + b * up_[2]};
}

Vector Projector::direction(double x, double y) const {
  if (!perspective_) return forward_;
  const auto [a, b] = slopes(x, y);
  return {forward_[0] + a * right_[0] + b * up_[0], forward_[1] + a * right_[1] + b * up_[1],
          forward_[2] + a * right_[2] + b * up_[2]};
}

std::vector<ProjectedNode> project_nodes(const ZooMesh& mesh, const Projector& projector) {
  auto nodes = large_vector<ProjectedNode>(mesh.node_count());
  parallel_for(nodes.size(), std::size_t{1} << 14, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      if (!projector.project(mesh.position(static_cast<NodeId>(i)), nodes[i]))
        nodes[i].depth = std::numeric_limits<double>::quiet_NaN();
  });
  return nodes;
}

std::array<CellMap::Point, CellMap::kMostNodes> relative_positions(const ZooMesh& mesh, CellId cell,
                                                                   const Projector& projector) {
  const auto nodes = mesh.cell_nodes(cell);
  std::array<CellMap::Point, CellMap::kMostNodes> positions;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    positions[k] = projector.relative(mesh.position(nodes[k]));
  return positions;
}

}  // namespace hiac
