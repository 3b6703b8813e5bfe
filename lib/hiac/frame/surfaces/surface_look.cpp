#include "hiac/frame/surfaces/surface_look.hpp"

#include <algorithm>
#include <cmath>

namespace hiac {
namespace {

FrameLight frame_light(const Light& light, const Projector& projector) {
  FrameLight result{!light.direction, {}, light.color};
  if (light.direction) {
    auto v = *light.direction;
    const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
    for (double& x : v) x /= largest;
    const double length = std::hypot(v[0], v[1], v[2]);
    for (double& x : v) x /= length;
    result.direction = projector.camera_vector(v);
  }
  return result;
}

}  // namespace

SurfaceLook look_of(const Isosurface& surface) {
  return {surface.color,    std::log1p(-surface.opacity),
          surface.ambient,  surface.diffuse,
          surface.specular, surface.shininess};
}

SurfaceLook look_of(const Skin& skin) {
  return {skin.color,    std::log1p(-skin.opacity), skin.ambient, skin.diffuse, skin.specular,
          skin.shininess};
}

double largest_light(const SurfaceLook& look, std::span<const Light> lights) {
  double largest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    double light = look.ambient * look.color[c];
    for (const Light& l : lights)
      light += l.color[c] * (look.diffuse * look.color[c] + look.specular);
    largest = std::max(largest, light);
  }
  return largest;
}

std::vector<FrameLight> frame_lights(std::span<const Light> lights, const Projector& projector) {
  std::vector<FrameLight> result;
  for (const Light& light : lights) result.push_back(frame_light(light, projector));
  return result;
}

}  // namespace hiac
