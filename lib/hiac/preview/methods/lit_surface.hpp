#pragma once

#include <array>
#include <span>

#include "hiac/frame/surfaces/isosurfaces.hpp"

namespace hiac::preview {

/// What an isosurface adds at one point: the colour that its opacity weighs (Phong's shading of
/// both sides, with lights as in the frame), and its optical depth, whose exponential is
/// transparency; at most kOpaqueDepth.
struct LitSurface {
  std::array<double, 3> color;
  double optical_depth;
  double face_on_depth;  ///< the same seen face-on
};
inline constexpr double kOpaqueDepth = 100;

/// `normal` (any side) and `ray` (away from the eye): of unit length, in right, up, forward.
LitSurface lit_surface(const FrameIsosurface& surface, std::span<const FrameLight> lights,
                       const std::array<double, 3>& normal, const std::array<double, 3>& ray);

}  // namespace hiac::preview
