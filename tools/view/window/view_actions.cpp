#include "tools/view/window/view_actions.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/geometry/box.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/scene/camera_motion.hpp"
#include "hiac/scene/camera_path.hpp"
#include "hiac/scene/toml/edited_text.hpp"
#include "tools/view/document/camera_text.hpp"

namespace hiac::view {
namespace {

constexpr double kUsualFov = 30;  // degrees, of a camera that becomes perspective

}  // namespace

ViewActions::ViewActions(Document& document) : document_(document) {
  connect(&document, &Document::mesh_changed, this, &ViewActions::measure_mesh);
  connect(&document, &Document::changed, this, &ViewActions::follow_document);
}

void ViewActions::measure_mesh() {
  if (!document_.mesh()) return;
  const Box box = box_of_cells(*document_.mesh());
  for (std::size_t c = 0; c < 3; ++c) ball_.middle[c] = box.low[c] / 2 + box.high[c] / 2;
  const double radius = box.diagonal() / 2;
  ball_.radius = radius > 0 ? radius : 1;
}

void ViewActions::follow_document() {
  if (document_.has_scene()) frame_ = std::min(frame_, frame_count(document_.scene()) - 1);
}

void ViewActions::set_frame(std::uint32_t frame) {
  if (!document_.has_scene() || frame >= frame_count(document_.scene()) || frame == frame_) return;
  frame_ = frame;
  Q_EMIT changed();
}

void ViewActions::set_samples(std::uint32_t samples) {
  samples_ = samples;
  Q_EMIT changed();
}

void ViewActions::set_hardware(bool on) {
  hardware_ = on;
  Q_EMIT changed();
}

std::optional<Wanted> ViewActions::wanted() const {
  if (!document_.has_scene() || !document_.mesh()) return std::nullopt;
  return Wanted{document_.mesh(), scene_of_frame(document_.scene(), frame_),
                document_.parsed().annotation, samples_, hardware_};
}

std::optional<Camera> ViewActions::camera() const {
  if (!document_.has_scene()) return std::nullopt;
  return camera_at(document_.scene(), frame_);
}

std::array<double, 2> ViewActions::depths() const {
  const auto now = camera();
  if (!now || !document_.mesh()) return {0, 1};
  const double middle = dot(minus(ball_.middle, now->eye), axes_of(*now).ahead);
  return {middle - ball_.radius, middle + ball_.radius};
}

// Makes an edit, or tells why there is none.
void ViewActions::edit(const QString& label, bool goes_on,
                       const std::function<std::string()>& text) {
  if (!document_.has_scene()) return;
  try {
    document_.edit(label, text(), goes_on);
  } catch (const Error& error) {
    Q_EMIT message(QString::fromStdString(error.what()));
  }
}

void ViewActions::move_camera(const Camera& camera, const QString& label, bool goes_on) {
  edit(label, goes_on, [&] {
    const auto keyframe = keyframe_at(document_.scene(), frame_);
    if (!keyframe)
      throw UsageError(fmt::format(
          "frame {} has no camera of its own: record a keyframe there, or go to one", frame_));
    return with_camera(document_.text(), document_.scene(), *keyframe, camera);
  });
}

void ViewActions::reset() {
  if (const auto now = camera(); now && document_.mesh())
    move_camera(framing(*now, ball_.middle, ball_.radius, document_.scene().image), tr("reset"),
                false);
}

void ViewActions::look_along(std::size_t axis, bool backwards) {
  const auto now = camera();
  if (!now) return;
  std::array<double, 3> ahead{}, up{};
  ahead[axis] = backwards ? 1 : -1;
  up[axis == 2 ? 1 : 2] = 1;
  move_camera(looking_along(*now, ahead, up), tr("axis view"), false);
}

void ViewActions::next_axis_view() {
  look_along(axis_view_ / 2, axis_view_ % 2 == 1);
  axis_view_ = (axis_view_ + 1) % 6;
}

void ViewActions::toggle_projection() {
  const auto now = camera();
  if (!now) return;
  const Projection other = now->projection == Projection::perspective ? Projection::orthographic
                                                                      : Projection::perspective;
  move_camera(with_projection(*now, other, kUsualFov), tr("projection"), false);
}

void ViewActions::toggle_color_bar() {
  edit(tr("colour bar"), false, [&] {
    const bool is_on = document_.parsed().annotation.color_bar.has_value();
    return with_key(document_.text(), "annotation.colorbar.show", is_on ? "false" : "true");
  });
}

void ViewActions::set_size(ImageSize size) {
  edit(tr("picture size"), false, [&] {
    const std::string wide = with_key(document_.text(), "image.width", std::to_string(size.width));
    return with_key(wide, "image.height", std::to_string(size.height));
  });
}

void ViewActions::set_clip(const std::optional<std::array<double, 2>>& clip, bool goes_on) {
  auto now = camera();
  if (!now) return;
  now->clip = clip;
  move_camera(*now, tr("clip"), goes_on);
}

void ViewActions::record_keyframe(std::uint32_t frame) {
  edit(tr("keyframe"), false,
       [&] { return with_keyframe(document_.text(), document_.scene(), frame, *camera()); });
}

}  // namespace hiac::view
