#pragma once

#include <array>
#include <span>

#include "hiac/frame/surfaces/surface_look.hpp"

namespace hiac {

/// The effect of an isosurface, or of another lit surface, on a ray that crosses it: the
/// premultiplied light that it adds, and its transparency.
struct IsosurfaceShade {
  std::array<double, 3> rgb;
  double transparency;
};

/// A point of a surface as a ray sees it, and its shade.
struct ShadedPoint {
  std::array<double, 3> normal, ray;  ///< as of shade_isosurface
  Color color;                        ///< of the surface there
  IsosurfaceShade shade;
};

/// Phong's shading of both sides of a surface (B. T. Phong, CACM 18, 1975), with N the normal on
/// the ray's side, V towards the eye, L towards a light and R = 2 (N.L) N - L:
///
///     ambient color + sum over lights (where N.L > 0) of
///         light (diffuse (N.L) color + specular max(R.V, 0)^shininess)
///
/// times the opacity 1 - (1 - opacity)^(1 / |N.V|): like a pane of glass, the surface is more
/// opaque at grazing angles (section 5.2).
///
/// `normal` (on either side) and `ray` (away from the eye) are unit vectors in the frame of the
/// lights: right, up, forward.
IsosurfaceShade shade_isosurface(const SurfaceLook& surface, std::span<const FrameLight> lights,
                                 const std::array<double, 3>& normal,
                                 const std::array<double, 3>& ray);

/// Sets the shades of points of a surface, whose look is `surface` in the colour of each point: the
/// same as of each by itself, in vectors.
void shade_points(const SurfaceLook& surface, std::span<const FrameLight> lights,
                  std::span<ShadedPoint> points);

}  // namespace hiac
