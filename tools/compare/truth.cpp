#include "tools/compare/truth.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/render/bounds/bounded_scene.hpp"
#include "hiac/scene/camera_path.hpp"
#include "hiac/session/error_bounds.hpp"
#include "hiac/session/session.hpp"
#include "tools/common/foreign_mesh.hpp"
#include "tools/common/picture/frames.hpp"

namespace hiac::tools {
namespace {

bool is_one_everywhere(const Image& image, std::size_t channel) {
  for (std::size_t y = 0; y < image.height(); ++y)
    for (std::size_t x = 0; x < image.width(); ++x)
      if (image.at(x, y, channel) != 1) return false;
  return true;
}

// The image's channels of these names.
Image with_channels(const Image& image, const std::vector<std::string>& names) {
  Image result(image.width(), image.height(), names);
  for (std::size_t c = 0; c < names.size(); ++c) {
    const std::size_t from = image.channel_index(names[c]).value();
    for (std::size_t y = 0; y < image.height(); ++y)
      for (std::size_t x = 0; x < image.width(); ++x) result.at(x, y, c) = image.at(x, y, from);
  }
  return result;
}

// The picture's colours and, unless that is 1 everywhere, its alpha.
Image without_opaque_alpha(Tool& tool, Image picture, const std::string& path) {
  std::vector<std::string> names;
  for (const std::string& name : rgba_channels())
    if (picture.channel_index(name)) names.push_back(name);
  if (names.empty() || !color_channels(picture))
    throw InputError(path, fmt::format("a picture of R, G and B expected (channels {} found)",
                                       fmt::join(picture.channels(), " ")));
  if (names.back() == "A" && is_one_everywhere(picture, *picture.channel_index("A"))) {
    names.pop_back();
    tool.note(path + ": alpha is 1 everywhere and is not compared");
  }
  return with_channels(picture, names);
}

bool has_alpha(const Image& image) { return image.channel_index("A").has_value(); }

// With the channel of error bounds, where bounds are claimed.
Picture picture_with_bounds(Tool& tool, Session& session, const Scene& scene,
                            PictureRequest request) {
  const auto reason = reason_unbounded(scene);
  if (!reason) request.channels = {"error"};
  Picture picture = session.picture(scene, request);
  if (reason) tool.note(fmt::format("the truth has no error bound: {}", *reason));
  return picture;
}

}  // namespace

void add_truth_options(CLI::App& app, PictureCommand& command) {
  auto* truth = app.add_option("--truth", command.input,
                               "Compare A with the exact picture of this mesh, a zoo mesh or any "
                               "file that hiac-convert reads, in A's size")
                    ->type_name("MESH");
  const auto of_truth = [&](CLI::Option* option) { option->needs(truth); };
  of_truth(app.add_option("--view", command.view,
                          "With --truth: the image specification (TOML), or a picture made by one "
                          "(default: A, if it holds its specification)")
               ->type_name("SPEC"));
  of_truth(app.add_option("--set", command.overrides,
                          "Override KEY=VALUE of the specification; repeatable")
               ->type_name("KEY=VALUE")
               ->allow_extra_args(false));
  of_truth(app.add_option("--frame", command.frame, "The frame of a camera path, counted from 0")
               ->type_name("N"));
  of_truth(app.add_flag("--no-background", command.no_background,
                        "A has no background: its pixels are of the volume alone"));
  of_truth(app.add_flag("--skip-invalid", command.skip_invalid,
                        "Leave out cells that are partly turned inside out"));
  add_conversion(app, command.conversion);
}

TruthRenderer::TruthRenderer(Tool& tool, PictureCommand command, Image& picture,
                             const std::string& path)
    : tool_(tool), command_(std::move(command)) {
  picture = without_opaque_alpha(tool_, std::move(picture), path);
  channels_.assign(picture.channels().begin(), picture.channels().end());
  if (command_.view.empty()) command_.view = path;
  command_.size = fmt::format("{}x{}", picture.width(), picture.height());
  std::optional<ParsedScene> parsed = specification_of(tool_, command_);
  check_frame_options(command_, parsed->scene);
  ZooFile file = mesh_of(tool_, command_);
  const ParsedScene view = scene_for(tool_, command_, std::move(parsed), file.mesh);
  if (view.annotation.draws())
    tool_.note("[annotation] is not drawn on the truth: where A has it, it differs");
  scene_ = view.scene.path ? scene_of_frame(view.scene, command_.frame.value_or(0)) : view.scene;
  request_.background =
      !command_.no_background && !(has_alpha(picture) && has_integer_samples(path));
  Monitor monitor = tool_.monitor();
  monitor.note = [this](const std::string& line) {
    if (!is_silent_) tool_.note(line);
  };
  session_ = std::make_unique<Session>(std::move(file.mesh), std::move(monitor));
  with_names(command_, [&] {
    if (command_.skip_invalid)
      note_skipped(tool_, session_->skip_invalid_cells(scene_), session_->mesh().cell_count());
    else
      hint_at_skip_invalid(command_, [&] { session_->require_drawable(scene_); });
  });
}

Truth TruthRenderer::truth() {
  const Picture drawn =
      with_names(command_, [&] { return picture_with_bounds(tool_, *session_, scene_, request_); });
  require_numbers(drawn.image);
  if (drawn.violations > 0)
    tool_.warn(fmt::format("the truth has {} ray segments out of order", drawn.violations));
  return {with_channels(drawn.image, channels_), largest_error_bound(drawn.image)};
}

Image TruthRenderer::picture_of(const Camera& camera, ImageSize size, std::uint32_t samples) {
  is_silent_ = true;
  Scene scene = scene_;
  scene.camera = camera;
  scene.image = size;
  PictureRequest request = request_;
  if (samples > 1) request.sampling = Supersampling{samples, SampleFilter::box};
  const Picture drawn = with_names(command_, [&] { return session_->picture(scene, request); });
  return with_channels(drawn.image, channels_);
}

}  // namespace hiac::tools
