#pragma once

#include "hiac/scene/scene.hpp"

namespace hiac {

/// Throws UsageError for a scene of whose pictures the channel "error" claims no bound: one with an
/// integration other than exact, an interpolation other than isoparametric, splats or a skin.
void require_bounded_scene(const Scene& scene);

}  // namespace hiac
