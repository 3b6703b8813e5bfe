#include "hiac/scene/camera_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hiac/geometry/rotation.hpp"
#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// a + s b
Vector along(const Vector& a, double s, const Vector& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

double distance_of(const Camera& camera) { return length(view_direction(camera)); }

// the vertical extent of the plane through look_at that the picture shows
double extent_of(const Camera& camera) {
  if (camera.projection == Projection::orthographic) return camera.height;
  return 2 * distance_of(camera) * std::tan(camera.fov * kDegree / 2);
}

// half the image's vertical angle, radians, if it sees `factor` times as much
double half_angle(const Camera& camera, double factor) {
  return std::atan(std::tan(camera.fov * kDegree / 2) * factor);
}

void shift(Camera& camera, const Vector& by) {
  camera.eye = along(camera.eye, 1, by);
  camera.look_at = along(camera.look_at, 1, by);
}

// Moves the eye to a distance from look_at. A slab of a perspective camera stays where it is.
void move_to_distance(Camera& camera, double distance) {
  const double moved = distance - distance_of(camera);
  camera.eye = along(camera.look_at, -distance, axes_of(camera).ahead);
  if (!camera.clip) return;
  const double near = (*camera.clip)[0] + moved, far = (*camera.clip)[1] + moved;
  if (far > std::max(near, 0.0)) camera.clip = {std::max(near, 0.0), far};
}

}  // namespace

CameraAxes axes_of(const Camera& camera) {
  const Vector ahead = unit(view_direction(camera));
  const Vector right = unit(cross(ahead, unit(camera.up)));
  return {right, cross(right, ahead), ahead};
}

Camera orbited(const Camera& camera, double across, double down) {
  const CameraAxes axes = axes_of(camera);
  const Turn sideways = turn_by(-across), over = turn_by(-down);
  // the vertical turn leaves up as it is, and turns right
  const Vector right = turned(axes.right, axes.up, sideways);
  const Vector back = minus(camera.eye, camera.look_at);
  Camera result = camera;
  result.eye = along(camera.look_at, 1, turned(turned(back, axes.up, sideways), right, over));
  result.up = turned(axes.up, right, over);
  return result;
}

Camera rolled(const Camera& camera, double degrees) {
  const CameraAxes axes = axes_of(camera);
  Camera result = camera;
  result.up = turned(axes.up, axes.ahead, turn_by(degrees));
  return result;
}

Camera panned(const Camera& camera, double right, double up) {
  const CameraAxes axes = axes_of(camera);
  const double extent = extent_of(camera);
  Camera result = camera;
  shift(result, along(along({}, -right * extent, axes.right), -up * extent, axes.up));
  return result;
}

Camera zoomed(const Camera& camera, double factor) {
  Camera result = camera;
  if (camera.projection == Projection::orthographic)
    result.height = camera.height / factor;
  else
    move_to_distance(result, distance_of(camera) / factor);
  return result;
}

Camera centred(const Camera& camera, const std::array<double, 3>& point) {
  Camera result = camera;
  shift(result, minus(point, camera.look_at));
  return result;
}

Camera looking_along(const Camera& camera, const std::array<double, 3>& ahead,
                     const std::array<double, 3>& up) {
  Camera result = camera;
  result.eye = along(camera.look_at, -distance_of(camera), unit(ahead));
  result.up = up;
  return result;
}

Camera widened(const Camera& camera, double factor) {
  Camera result = camera;
  result.height *= factor;
  result.fov = half_angle(camera, factor) / (kDegree / 2);
  return result;
}

Camera with_projection(const Camera& camera, Projection projection, double fov) {
  if (camera.projection == projection) return camera;
  Camera result = camera;
  result.projection = projection;
  const double extent = extent_of(camera);
  if (projection == Projection::orthographic) {
    result.height = extent;
    result.fov = 0;
    return result;
  }
  result.fov = fov;
  result.height = 0;
  move_to_distance(result, extent / 2 / std::tan(fov * kDegree / 2));
  return result;
}

Camera framing(const Camera& camera, const std::array<double, 3>& middle, double radius,
               ImageSize size) {
  constexpr double kMargin = 1.05;
  Camera result = camera;
  const Vector ahead = axes_of(camera).ahead;
  // of the picture's half extents, the smaller one relative to the vertical one
  const double narrow = std::min(1.0, static_cast<double>(size.width) / size.height);
  double distance = distance_of(camera);
  if (camera.projection == Projection::orthographic) {
    result.height = 2 * kMargin * radius / narrow;
  } else {
    distance = kMargin * radius / std::sin(half_angle(camera, narrow));
  }
  result.look_at = middle;
  result.eye = along(middle, -distance, ahead);
  return result;
}

std::array<double, 3> point_at(const Camera& camera, ImageSize size, double x, double y,
                               double depth) {
  const CameraAxes axes = axes_of(camera);
  const double pixel = extent_of(camera) / size.height;
  const double scale =
      camera.projection == Projection::orthographic ? 1 : depth / distance_of(camera);
  const double right = (x - size.width / 2.0 - camera.shift[0]) * pixel * scale;
  const double up = (size.height / 2.0 + camera.shift[1] - y) * pixel * scale;
  return along(along(along(camera.eye, depth, axes.ahead), right, axes.right), up, axes.up);
}

}  // namespace hiac
