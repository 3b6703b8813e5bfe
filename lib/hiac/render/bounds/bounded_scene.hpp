#pragma once

#include <optional>
#include <string>

#include "hiac/scene/scene.hpp"

namespace hiac {

/// Why the channel "error" claims no bound of a scene's pictures, for people: an integration other
/// than exact, an interpolation other than isoparametric, or splats. None if it claims one.
std::optional<std::string> reason_unbounded(const Scene& scene);

/// Throws UsageError, with the reason, for a scene of which no bound is claimed.
void require_bounded_scene(const Scene& scene);

}  // namespace hiac
