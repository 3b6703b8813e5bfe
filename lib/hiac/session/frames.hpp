#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hiac/scene/scene.hpp"

namespace hiac {

/// The numbers of the requested frames of a scene: all of them, or `one`. Throws UsageError "frame
/// N: ..." when that frame does not exist, or when the scene has no camera path.
std::vector<std::uint32_t> frames_of(const Scene& scene, const std::optional<std::uint32_t>& one);

}  // namespace hiac
