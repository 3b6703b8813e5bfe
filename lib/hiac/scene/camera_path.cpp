#include "hiac/scene/camera_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/geometry/rotation.hpp"
#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

Vector between(const Vector& a, const Vector& b, double s) {
  return {std::lerp(a[0], b[0], s), std::lerp(a[1], b[1], s), std::lerp(a[2], b[2], s)};
}

// Interpolates between two slabs, whose far planes may be infinitely far.
std::array<double, 2> slab_between(const std::array<double, 2>& a, const std::array<double, 2>& b,
                                   double s) {
  const bool endless = std::isinf(a[1]) || std::isinf(b[1]);
  return {std::lerp(a[0], b[0], s),
          endless ? std::numeric_limits<double>::infinity() : std::lerp(a[1], b[1], s)};
}

// Returns the velocity of a point of the camera at a keyframe, in world units per frame.
Vector velocity(const std::vector<Keyframe>& keyframes, std::size_t at, Vector Camera::*point) {
  const Keyframe& before = keyframes[at == 0 ? 0 : at - 1];
  const Keyframe& after = keyframes[std::min(at + 1, keyframes.size() - 1)];
  const double frames = after.frame - before.frame;
  Vector result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = ((after.camera.*point)[i] - (before.camera.*point)[i]) / frames;
  return result;
}

// The cubic in Hermite's form between keyframes `at` and `at` + 1, s from 0 to 1; in this form a
// point that does not move stays the same to the last bit.
Vector on_spline(const std::vector<Keyframe>& keyframes, std::size_t at, double s,
                 Vector Camera::*point) {
  const Vector &p = keyframes[at].camera.*point, &q = keyframes[at + 1].camera.*point;
  const Vector u = velocity(keyframes, at, point), v = velocity(keyframes, at + 1, point);
  const double frames = keyframes[at + 1].frame - keyframes[at].frame;
  const double r = 1 - s;
  Vector result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = p[i] + s * s * (1 + 2 * r) * (q[i] - p[i]) + frames * s * r * (r * u[i] - s * v[i]);
  return result;
}

Camera camera_on_path(const KeyframePath& path, std::uint32_t frame) {
  const auto& keyframes = path.keyframes;
  const auto after = std::ranges::upper_bound(keyframes, frame, {}, &Keyframe::frame);
  const auto at = static_cast<std::size_t>(after - keyframes.begin()) - 1;
  const Camera& p = keyframes[at].camera;
  if (keyframes[at].frame == frame) return p;
  const Camera& q = keyframes[at + 1].camera;
  const double s = static_cast<double>(frame - keyframes[at].frame) /
                   static_cast<double>(keyframes[at + 1].frame - keyframes[at].frame);
  Camera camera = p;
  if (path.interpolation == PathInterpolation::linear) {
    camera.eye = between(p.eye, q.eye, s);
    camera.look_at = between(p.look_at, q.look_at, s);
  } else {
    camera.eye = on_spline(keyframes, at, s, &Camera::eye);
    camera.look_at = on_spline(keyframes, at, s, &Camera::look_at);
  }
  camera.up = between(unit(p.up), unit(q.up), s);
  camera.fov = std::lerp(p.fov, q.fov, s);
  camera.height = std::lerp(p.height, q.height, s);
  if (p.clip) camera.clip = slab_between(*p.clip, *q.clip, s);
  return camera;
}

Camera camera_on_turntable(const Camera& start, const Turntable& table, std::uint32_t frame) {
  if (frame == 0) return start;
  const Turn turn = turn_by(table.degrees * frame / table.frames);
  const Vector axis = unit(table.axis.value_or(start.up));
  const Vector towards = view_direction(start);
  const Vector back = turned({-towards[0], -towards[1], -towards[2]}, axis, turn);
  Camera camera = start;
  for (std::size_t i = 0; i < 3; ++i) camera.eye[i] = start.look_at[i] + back[i];
  camera.up = turned(start.up, axis, turn);
  return camera;
}

}  // namespace

std::uint32_t frame_count(const Scene& scene) {
  if (!scene.path) return 1;
  if (const auto* table = std::get_if<Turntable>(&*scene.path)) return table->frames;
  return std::get<KeyframePath>(*scene.path).keyframes.back().frame + 1;
}

Camera camera_at(const Scene& scene, std::uint32_t frame) {
  if (!scene.path) return scene.camera;
  if (const auto* table = std::get_if<Turntable>(&*scene.path))
    return camera_on_turntable(scene.camera, *table, frame);
  return camera_on_path(std::get<KeyframePath>(*scene.path), frame);
}

Scene scene_of_frame(const Scene& scene, std::uint32_t frame) {
  Scene one = scene;
  one.camera = camera_at(scene, frame);
  one.path.reset();
  return one;
}

}  // namespace hiac
