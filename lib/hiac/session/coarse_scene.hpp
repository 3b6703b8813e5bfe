#pragma once

#include <cstdint>

#include "hiac/scene/scene.hpp"

namespace hiac {

/// A scene whose pixels are some of those of another scene: every `step`th of every `step`th row.
///
/// Its pixel (i, j) has the ray of pixel (left + i step, top + j step) of the whole picture, to
/// within the rounding of the camera's numbers, and stands for a square of step x step pixels,
/// which begins (step - 1) / 2 pixels, rounded down, to the left of that one and above it. Together
/// these squares cover the picture; those at its border may reach beyond it.
struct CoarseScene {
  Scene scene;
  std::uint32_t step = 1;
  std::int64_t left = 0, top = 0;
};

/// With a `step` of 1 the scene stays as it is, to the bit. Lengths that are given in pixels
/// (the width of edges) follow. The background is that of few pixels: draw without it and composite
/// that of the whole picture. The visibility order is that of the scene (view_hash).
CoarseScene coarse_scene(const Scene& scene, std::uint32_t step);

}  // namespace hiac
