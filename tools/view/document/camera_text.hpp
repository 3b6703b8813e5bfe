#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "hiac/scene/scene.hpp"

namespace hiac::view {

/// Which camera of a specification is that of a frame: the number of the keyframe, and 0 of a text
/// with one camera. None between keyframes, and on a turntable's frames other than 0: no key says
/// what the camera is there.
std::optional<std::size_t> keyframe_at(const Scene& scene, std::uint32_t frame);

/// The text with another camera, that of a keyframe (0 of a text with one camera). Keys whose
/// values are the same stay as they are, and so do all comments and all other keyframes. `scene`:
/// what the text says.
std::string with_camera(std::string text, const Scene& scene, std::size_t keyframe,
                        const Camera& after);

/// The text with a keyframe at a frame: that of the path if it is there already, a further one, or,
/// of a text without a path, the second of a new path, whose first is the present camera at frame
/// 0. `scene`: what the text says. Throws UsageError for frame 0 of a text without a path, and if
/// the text has a turntable.
std::string with_keyframe(std::string text, const Scene& scene, std::uint32_t frame,
                          const Camera& camera);

}  // namespace hiac::view
