#include "hiac/preview/methods/lit_surface.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/geometry/vector.hpp"

namespace hiac::preview {

LitSurface lit_surface(const FrameIsosurface& surface, std::span<const FrameLight> lights,
                       const Vector& normal, const Vector& ray) {
  const Vector eye{-ray[0], -ray[1], -ray[2]};
  const double facing = dot(normal, eye);
  const double side = facing < 0 ? -1 : 1;
  LitSurface lit{};
  for (std::size_t c = 0; c < 3; ++c) lit.color[c] = surface.ambient * surface.color[c];
  for (const FrameLight& light : lights) {
    const Vector& towards = light.headlight ? eye : light.direction;
    const double nl = side * dot(normal, towards);
    if (nl <= 0) continue;
    // R.V with R = 2 (N.L) N - L
    const double mirrored = 2 * nl * side * facing - dot(towards, eye);
    const double highlight =
        mirrored > 0 ? surface.specular * std::pow(mirrored, surface.shininess) : 0;
    for (std::size_t c = 0; c < 3; ++c)
      lit.color[c] += light.color[c] * (surface.diffuse * nl * surface.color[c] + highlight);
  }
  // seen at an angle, glass of some thickness is the more opaque
  lit.optical_depth = std::min(-surface.log_transparency / std::abs(facing), kOpaqueDepth);
  lit.face_on_depth = std::min(-surface.log_transparency, kOpaqueDepth);
  if (!(lit.optical_depth >= 0)) lit.optical_depth = 0;  // no opacity, seen edge-on
  return lit;
}

}  // namespace hiac::preview
