#include "tools/common/render/shots.hpp"

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/camera_path.hpp"
#include "tools/common/picture/frames.hpp"
#include "tools/common/picture/picture_output.hpp"
#include "tools/common/render/movie.hpp"

namespace hiac::tools {
namespace {

std::string path_of(const PictureCommand& command, const char* of, std::size_t number) {
  return is_movie(command.output) ? fmt::format("{}, {} {}", command.output, of, number)
                                  : frame_path(command.output, number);
}

}  // namespace

std::vector<Shot> shots_of_frames(const PictureCommand& command, const Scene& scene) {
  std::vector<Shot> shots;
  for (const std::uint32_t frame : chosen_frames(scene, command.frame))
    shots.push_back({0, 0, frame,
                     is_movie(command.output) ? path_of(command, "frame", frame)
                                              : path_of_frame(command, frame)});
  return shots;
}

std::vector<Shot> shots_of_steps(const PictureCommand& command, const Scene& scene,
                                 const MeshSeries& series) {
  std::vector<Shot> shots;
  if (!command.all_frames) {
    for (std::size_t k = 0; k < series.size(); ++k) {
      const std::size_t number = series[k].number;
      shots.push_back({k, number, command.frame, path_of(command, "step", number)});
    }
    return shots;
  }
  const std::vector<std::uint32_t> frames = chosen_frames(scene, std::nullopt);
  if (frames.size() < series.size())
    throw UsageError(
        fmt::format("--frames: {} has {} frames, fewer than the {} steps (as many expected, or "
                    "more)",
                    command.view, frames.size(), series.size()));
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const std::size_t step = k * series.size() / frames.size();
    shots.push_back({step, series[step].number, frames[k], path_of(command, "frame", frames[k])});
  }
  return shots;
}

Scene scene_of_shot(const Scene& scene, const Shot& shot) {
  return shot.frame ? scene_of_frame(scene, *shot.frame) : scene;
}

}  // namespace hiac::tools
