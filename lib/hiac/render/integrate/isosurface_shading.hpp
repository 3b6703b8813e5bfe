#pragma once

#include <array>
#include <span>

#include "hiac/frame/isosurfaces.hpp"

namespace hiac {

/// What an isosurface does where a ray crosses it: premultiplied light of its own, and the share of
/// what is behind that it lets through.
struct IsosurfaceShade {
  std::array<double, 3> rgb;
  double transparency;
};

/// Phong's shading of both sides of a surface (B. T. Phong, CACM 18, 1975), with N the normal on
/// the ray's side, V towards the eye, L towards a light and R = 2 (N.L) N - L:
///
///     ambient color + sum over lights (where N.L > 0) of
///         light (diffuse (N.L) color + specular max(R.V, 0)^shininess)
///
/// times the opacity 1 - (1 - opacity)^(1 / |N.V|): seen at an angle, glass of some thickness is
/// the more opaque (section 5.2).
///
/// `normal` (any side) and `ray` (away from the eye) are of unit length, in one frame with the
/// lights: right, up, forward.
IsosurfaceShade shade_isosurface(const FrameIsosurface& surface, std::span<const FrameLight> lights,
                                 const std::array<double, 3>& normal,
                                 const std::array<double, 3>& ray);

}  // namespace hiac
