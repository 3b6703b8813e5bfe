#include "hiac/render/projection.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "hiac/base/parallel.hpp"
#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

// Beyond this many pixels from the centre a projected coordinate has lost too many digits to be
// scan converted (an ulp is then 3e-11 pixels); such nodes, close to the eye plane, count as not
// projectable, and their cells are met by their rays in world space.
constexpr double kFarthestPixel = 131072;

// Projected coordinates as close as rounding to the centres of a column or row of pixels lie on
// them: faces seen edge-on along pixel centres, as views along an axis have them, stay straight
// when their corners are projected, and rays in them lie on one side all along.
constexpr double kCenterRounding = 0x1p-38;

double at_center(double coordinate) {
  const double center = std::floor(coordinate) + 0.5;
  return std::abs(coordinate - center) <= kCenterRounding ? center : coordinate;
}

}  // namespace

Projector::Projector(const Camera& camera, ImageSize size)
    : perspective_(camera.projection == Projection::perspective),
      anchor_(perspective_ ? camera.eye : camera.look_at),
      forward_(unit(view_direction(camera))),
      center_x_(size.width / 2.0),
      center_y_(size.height / 2.0),
      near_(perspective_ ? 0 : -std::numeric_limits<double>::infinity()),
      far_(std::numeric_limits<double>::infinity()) {
  right_ = unit(cross(forward_, camera.up));
  up_ = cross(right_, forward_);
  const double half = size.height / 2.0;
  scale_ = perspective_ ? half / std::tan(camera.fov * (std::numbers::pi / 360))
                        : size.height / camera.height;
  const Vector to_eye = view_direction(camera);
  offset_ = perspective_ ? 0 : std::hypot(to_eye[0], to_eye[1], to_eye[2]);
  if (camera.clip) {
    near_ = (*camera.clip)[0] - offset_;
    far_ = (*camera.clip)[1] - offset_;
  }
}

Vector Projector::camera_vector(const Vector& v) const {
  return {dot(v, right_), dot(v, up_), dot(v, forward_)};
}

Vector Projector::camera_coordinates(std::span<const double, 3> point) const {
  return camera_vector(minus(point, anchor_));
}

bool Projector::project(std::span<const double, 3> point, ProjectedNode& node) const {
  const Vector c = camera_coordinates(point);
  if (!perspective_) {
    node = {at_center(center_x_ + scale_ * c[0]), at_center(center_y_ - scale_ * c[1]), c[2]};
    return true;
  }
  const double reciprocal = 1 / c[2];
  const double dx = scale_ * (c[0] * reciprocal), dy = scale_ * (c[1] * reciprocal);
  node = {at_center(center_x_ + dx), at_center(center_y_ - dy), -reciprocal};
  return c[2] > 0 && std::abs(dx) < kFarthestPixel && std::abs(dy) < kFarthestPixel;
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

std::array<double, 2> Projector::slopes(double x, double y) const {
  return {(x - center_x_) / scale_, (center_y_ - y) / scale_};
}

double Projector::ray_scale(double x, double y) const {
  if (!perspective_) return 1;
  const auto [a, b] = slopes(x, y);
  return std::sqrt(a * a + b * b + 1);  // section 5.1: the slanted distance
}

std::vector<ProjectedNode> project_nodes(const ZooMesh& mesh, const Projector& projector) {
  std::vector<ProjectedNode> nodes(mesh.node_count());
  parallel_for(nodes.size(), std::size_t{1} << 14, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      if (!projector.project(mesh.position(static_cast<NodeId>(i)), nodes[i]))
        nodes[i].depth = std::numeric_limits<double>::quiet_NaN();
  });
  return nodes;
}

}  // namespace hiac
