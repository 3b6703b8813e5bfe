#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hiac/scene/scene.hpp"
#include "tools/common/picture/picture_command.hpp"
#include "tools/common/render/mesh_series.hpp"

namespace hiac::tools {

/// One picture of a run.
struct Shot {
  std::size_t step, step_number;       ///< which of the series' steps, and its number
  std::optional<std::uint32_t> frame;  ///< of the camera's path; none: the scene has one view
  /// Its file, or what messages call it in a film.
  std::string path;
};

/// The pictures of a scene with a camera path, whose frames --frame and --frames choose.
std::vector<Shot> shots_of_frames(const PictureCommand& command, const Scene& scene);

/// The pictures of a series: one of every step, with the step's number; or, with --frames, one of
/// every frame, with the frame's number, over which the steps are spread evenly. Throws UsageError
/// if there are more steps than frames.
std::vector<Shot> shots_of_steps(const PictureCommand& command, const Scene& scene,
                                 const MeshSeries& series);

/// The scene of a shot, of one frame.
Scene scene_of_shot(const Scene& scene, const Shot& shot);

}  // namespace hiac::tools
