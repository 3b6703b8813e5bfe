#pragma once

#include <array>
#include <span>
#include <vector>

#include "hiac/frame/projection.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// What decides how a surface looks: its colour and opacity, and the light that it reflects. See
/// Isosurface (scene.hpp) for the parameters.
struct SurfaceLook {
  Color color;
  double log_transparency;  ///< log(1 - opacity), seen face-on; -infinity if opaque
  double ambient, diffuse, specular, shininess;
};

SurfaceLook look_of(const Isosurface& surface);
/// With the skin's one colour, whether or not a field replaces it.
SurfaceLook look_of(const Skin& skin);

/// An upper bound of the light of a surface, any channel.
double largest_light(const SurfaceLook& look, std::span<const Light> lights);

struct FrameLight {
  bool headlight;
  std::array<double, 3> direction;  ///< towards the light: unit length, right, up and forward
  Color color;
};

/// The scene's lights in the camera's frame.
std::vector<FrameLight> frame_lights(std::span<const Light> lights, const Projector& projector);

}  // namespace hiac
