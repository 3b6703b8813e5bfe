#include "hiac/session/starter/starter_camera.hpp"

#include <algorithm>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "hiac/base/special_values.hpp"

namespace hiac::starter {
namespace {

constexpr double kFov = 30;
/// The fraction of the image that the model may fill; curved cells can bulge a little beyond their
/// nodes.
constexpr double kFilled = 0.94;
constexpr Vec kUp{0, 0, 1};

Vec rounded(const Vec& v, double scale) {
  return {starter::rounded(v[0], scale), starter::rounded(v[1], scale),
          starter::rounded(v[2], scale)};
}

Frame frame_along(const Vec& direction) {
  const Vec ahead = unit(direction);
  const Vec right = unit(cross(ahead, kUp));
  return {right, cross(right, ahead), ahead};
}

/// Does `work` on every point that the camera has to see.
template <typename Work>
void for_each_point(const Sight& sight, const Work& work) {
  for (const NodeId node : sight.mesh.nodes) work(position(sight.mesh, node));
  for (const Vec& corner : sight.corners) work(corner);
}

/// The point at the middle of what is seen along a frame, at the middle depth.
Vec middle_seen(const Sight& sight, const Frame& frame, const Vec& center) {
  Vec low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for_each_point(sight, [&](const Vec& point) {
    const Vec p = point - center;
    const Vec at{dot(p, frame.right), dot(p, frame.up), dot(p, frame.ahead)};
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], at[a]);
      high[a] = std::max(high[a], at[a]);
    }
  });
  const Vec middle = 0.5 * (low + high);
  return center + (middle[0] * frame.right + middle[1] * frame.up + middle[2] * frame.ahead);
}

}  // namespace

double rounded(double value, double scale) {
  const int digits = 3 - static_cast<int>(std::floor(std::log10(scale)));
  if (digits > 0) return std::stod(fmt::format("{:.{}f}", value, digits));
  const double step = std::pow(10, -digits);
  return std::round(value / step) * step;
}

Frame frame_of(const Camera& camera) { return frame_along(view_direction(camera)); }

bool has_extent(const ZooMesh& mesh) {
  const auto [low, high] = box_of_cells(mesh);
  return low != high;
}

Sight::Sight(const ZooMesh& cells, const Box& series) : Sight(cells) {
  const Box own = box;
  box.include(series);
  if (box.low == own.low && box.high == own.high) return;
  for (const double x : {box.low[0], box.high[0]})
    for (const double y : {box.low[1], box.high[1]})
      for (const double z : {box.low[2], box.high[2]}) corners.push_back({x, y, z});
}

Camera camera_around(const Sight& sight, const ImageSize& image, const Vec& towards_eye) {
  const auto& [low, high] = sight.box;
  const Vec extent = high - low;
  const double size = std::max({extent[0], extent[1], extent[2], 1e-300});
  const Frame frame = frame_along(-1 * towards_eye);
  const Vec look_at = rounded(middle_seen(sight, frame, 0.5 * low + 0.5 * high), size);
  const double half_height = kFilled * std::tan(0.5 * kFov * std::numbers::pi / 180);
  const double half_width = half_height * image.width / image.height;
  double distance = 0.01 * size;
  for_each_point(sight, [&](const Vec& point) {
    const Vec p = point - look_at;
    const double needed = std::max(std::fabs(dot(p, frame.up)) / half_height,
                                   std::fabs(dot(p, frame.right)) / half_width);
    distance = std::max(distance, needed - dot(p, frame.ahead));
  });
  Camera camera;
  camera.look_at = look_at;
  camera.eye = rounded(look_at - distance * frame.ahead, size);
  camera.up = kUp;
  camera.fov = kFov;
  return camera;
}

ImageSize fitting_size(const Sight& sight, const ImageSize& image, const Vec& towards_eye) {
  constexpr std::uint32_t kLeastSide = 64;
  const Camera camera = camera_around(sight, image, towards_eye);
  const Frame frame = frame_of(camera);
  double across = 0, upright = 0;
  for_each_point(sight, [&](const Vec& point) {
    const Vec p = point - camera.eye;
    const double depth = dot(p, frame.ahead);
    across = std::max(across, std::fabs(dot(p, frame.right)) / depth);
    upright = std::max(upright, std::fabs(dot(p, frame.up)) / depth);
  });
  const double aspect = across / upright;
  const auto side = [&](double wanted, std::uint32_t most) {
    // even: many video and image tools want it
    const double even = 2 * std::ceil(0.5 * wanted);
    return static_cast<std::uint32_t>(std::clamp(even, double{kLeastSide}, double(most)));
  };
  if (aspect * image.height > image.width)
    return {image.width, side(image.width / aspect, image.height)};
  return {side(image.height * aspect, image.width), image.height};
}

}  // namespace hiac::starter
