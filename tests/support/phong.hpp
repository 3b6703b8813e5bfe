#pragma once

#include <array>
#include <cmath>
#include <span>

#include "hiac/scene/scene.hpp"

namespace hiac::test {

/// Phong's shading of an isosurface by the book, in extended precision and world coordinates: light
/// that leaves it, opacity included, and its transparency. `normal` of any length but 0; `ray`
/// points away from the eye.
struct ReferenceShade {
  std::array<long double, 3> rgb;
  long double transparency;
};

inline ReferenceShade reference_shade(const Isosurface& surface, std::span<const Light> lights,
                                      std::array<long double, 3> normal,
                                      std::array<long double, 3> ray) {
  using Real = long double;
  using Vec = std::array<Real, 3>;
  const auto dot = [](const Vec& a, const Vec& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  const auto unit = [&](Vec v) {
    const Real length = std::sqrt(dot(v, v));
    for (Real& x : v) x /= length;
    return v;
  };
  const Vec d = unit(ray), eye{-d[0], -d[1], -d[2]};
  Vec n = unit(normal);
  if (dot(n, eye) < 0) n = {-n[0], -n[1], -n[2]};
  ReferenceShade shade{};
  for (std::size_t c = 0; c < 3; ++c)
    shade.rgb[c] = static_cast<Real>(surface.ambient) * surface.color[c];
  for (const Light& light : lights) {
    Vec l = eye;
    if (light.direction)
      l = unit({(*light.direction)[0], (*light.direction)[1], (*light.direction)[2]});
    const Real nl = dot(n, l);
    if (nl <= 0) continue;
    Vec mirrored;
    for (std::size_t k = 0; k < 3; ++k) mirrored[k] = 2 * nl * n[k] - l[k];
    const Real rv = dot(mirrored, eye);
    const Real highlight =
        rv > 0 ? surface.specular * std::pow(rv, static_cast<Real>(surface.shininess)) : 0;
    for (std::size_t c = 0; c < 3; ++c)
      shade.rgb[c] += light.color[c] * (surface.diffuse * nl * surface.color[c] + highlight);
  }
  shade.transparency = std::pow(1 - static_cast<Real>(surface.opacity), 1 / std::abs(dot(n, eye)));
  for (Real& channel : shade.rgb) channel *= 1 - shade.transparency;
  return shade;
}

}  // namespace hiac::test
