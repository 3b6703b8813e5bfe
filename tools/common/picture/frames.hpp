#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hiac/scene/scene.hpp"

namespace hiac::tools {

/// The numbers of the frames of a scene that are asked for: all of them, or the one that --frame
/// names. Throws UsageError when a frame is named that is not there, or any of a scene without a
/// camera path.
std::vector<std::uint32_t> chosen_frames(const Scene& scene,
                                         const std::optional<std::uint32_t>& one);

/// The name of a frame's file, or a time step's: its number in place of the name's one %d or %04d
/// (any width), or, where it has none, before the extension with at least four digits: out.png,
/// out-0012.png. Throws UsageError when the name has several places for the number.
std::string frame_path(const std::string& path, std::size_t frame);

/// Whether a name has a place for a frame's number: %d, %04d.
bool has_frame_number(const std::string& path);

}  // namespace hiac::tools
