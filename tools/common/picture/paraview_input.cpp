#include "tools/common/picture/paraview_input.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/paraview/paraview_view.hpp"
#include "hiac/scene/toml/spec_key.hpp"
#include "tools/common/as_option.hpp"

namespace hiac::tools {
namespace {

/// Whether a mesh may come through stdin: it is a pipe or a file, not a terminal or /dev/null.
bool has_piped_stdin() {
  struct stat status {};
  return fstat(STDIN_FILENO, &status) == 0 &&
         (S_ISFIFO(status.st_mode) || S_ISREG(status.st_mode) || S_ISSOCK(status.st_mode));
}

/// A camera as overrides of a starter view, whose camera has a perspective projection.
std::vector<Override> overrides_of(const Camera& camera) {
  const auto key = [](const char* name, const std::string& value) {
    return fmt::format("camera.{}={}", name, value);
  };
  std::vector<Override> overrides{key("eye", toml_text(camera.eye)),
                                  key("look_at", toml_text(camera.look_at)),
                                  key("up", toml_text(camera.up))};
  if (camera.projection == Projection::perspective) {
    overrides.push_back(key("fov", toml_text(camera.fov)));
    return overrides;
  }
  overrides.push_back(key("projection", "orthographic"));
  overrides.push_back(key("fov", ""));
  overrides.push_back(key("height", toml_text(camera.height)));
  return overrides;
}

}  // namespace

std::optional<ParsedScene> paraview_specification(Tool& tool, PictureCommand& command) {
  const ParaviewView view = view_from_state(command.view);
  for (const std::string& line : view.notes) tool.note(line);
  for (const std::string& line : view.omitted)
    tool.warn(fmt::format("{}: not as in ParaView: {}", command.view, line));
  if (command.strict && !view.omitted.empty())
    throw JudgementError(fmt::format("{}: not written: not as in ParaView: {} (--strict)",
                                     command.output, view.omitted.front()));
  if (view.is_camera_file) {
    const std::vector<Override> camera =
        overrides_of(parse_scene(view.text, command.view).scene.camera);
    command.overrides.insert(command.overrides.begin(), camera.begin(), camera.end());
    return std::nullopt;
  }
  if (command.input.empty() && !view.data_file.empty() && !has_piped_stdin()) {
    command.input = view.data_file;
    tool.claim_found(command.input);
    tool.note(fmt::format("mesh: {}, which the state names", command.input));
  }
  return as_option("--set ",
                   [&] { return parse_scene(view.text, command.view, "", command.overrides); });
}

}  // namespace hiac::tools
