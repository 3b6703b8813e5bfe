#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "hiac/scene/annotation_keys.hpp"
#include "hiac/scene/camera_keys.hpp"
#include "hiac/scene/color_source.hpp"
#include "hiac/scene/extinction_source.hpp"
#include "hiac/scene/scene_keys.hpp"
#include "hiac/scene/specification.hpp"
#include "hiac/scene/starter_text.hpp"

namespace hiac {
namespace {

/// Returns the keys of one table; with comments, also the names of the omitted ones.
template <typename T>
std::string keys_text(std::span<const SpecKey<T>> keys, const T& from, Comments comments) {
  std::string text;
  for (const SpecKey<T>& key : keys) {
    if (key.meaning.empty()) continue;  // a table, which is written separately
    const std::optional<std::string> value = key.write != nullptr ? key.write(from) : std::nullopt;
    const bool explain = comments == Comments::explain;
    if (!value && explain) text += fmt::format("# {} =  # {}\n", key.name, key.meaning);
    if (!value) continue;
    const bool long_value = value->find('\n') != std::string::npos;
    if (explain && long_value) text += fmt::format("# {}\n", key.meaning);
    text += fmt::format("{} = {}", key.name, *value);
    if (explain && !long_value) text += fmt::format("  # {}", key.meaning);
    text += '\n';
  }
  return text;
}

std::string cameras_text(const Scene& scene, Comments comments) {
  const auto* path = scene.path ? std::get_if<KeyframePath>(&*scene.path) : nullptr;
  std::string text;
  if (path == nullptr) {
    text += "\n[camera]\n" + keys_text(camera_keys(), scene.camera, comments);
    if (scene.path)
      text += "\n[turntable]\n" +
              keys_text(turntable_keys(), std::get<Turntable>(*scene.path), comments);
    return text;
  }
  for (const Keyframe& keyframe : path->keyframes)
    text += fmt::format("\n[[camera]]\nframe = {}\n", keyframe.frame) +
            keys_text(camera_keys(), keyframe.camera, comments);
  return text + "\n[camera_path]\n" + keys_text(camera_path_keys(), *path, comments);
}

std::string volume_text(const Scene& scene, const std::optional<ColorSource>& color,
                        Comments comments) {
  std::string text = "\n[volume]\n" + keys_text(volume_keys(), scene.volume, comments);
  if (color) text += "\n[volume.color]\n" + keys_text(color_keys(), *color, comments);
  if (scene.volume.extinction)
    text += "\n[volume.extinction]\n" +
            keys_text(extinction_keys(), {*scene.volume.extinction, {}}, comments);
  return text;
}

std::string skin_text(const Skin& skin, Comments comments) {
  std::string text = "\n[skin]\n" + keys_text(skin_keys(), skin, comments);
  if (!skin.color_by) return text;
  ColorSource color;
  color.transfer = *skin.color_by;
  return text + "\n[skin.color]\n" + keys_text(color_keys(), color, comments);
}

std::string edges_text(const Edges& edges, Comments comments) {
  return "\n[edges]\n" + keys_text(edge_keys(), edges, comments);
}

std::string scene_text(const Scene& scene, const std::optional<ColorSource>& color,
                       Comments comments) {
  std::string text = "[image]\n" + keys_text(image_keys(), scene.image, comments);
  text += cameras_text(scene, comments);
  text += volume_text(scene, color, comments);
  for (const Isosurface& surface : scene.isosurfaces)
    text += "\n[[isosurface]]\n" + keys_text(isosurface_keys(), surface, comments);
  if (scene.skin) text += skin_text(*scene.skin, comments);
  if (scene.edges) text += edges_text(*scene.edges, comments);
  for (const Light& light : scene.lights)
    text += "\n[[light]]\n" + keys_text(light_keys(), light, comments);
  text += "\n[background]\n" + keys_text(background_keys(), scene.background, comments);
  text += "\n[render]\n" + keys_text(render_keys(), scene.render, comments);
  return text;
}

/// The tables of an annotation, one text each.
std::vector<std::string> annotation_texts(const Annotation& a, Comments comments) {
  std::vector<std::string> texts{"[annotation]\n" + keys_text(annotation_keys(), a, comments)};
  const auto add = [&](const char* name, const auto& keys, const auto& part) {
    if (part)
      texts.push_back(fmt::format("[annotation.{}]\n", name) + keys_text(keys, *part, comments));
  };
  add("title", title_keys(), a.title);
  add("time", time_keys(), a.time);
  add("axes", axes_keys(), a.axes);
  add("scale", length_keys(), a.scale);
  add("colorbar", color_bar_keys(), a.color_bar);
  // points as they are written do not tell the scale of [volume.color]
  if (!a.color_bar && a.bar_is_logarithmic)
    texts.emplace_back("[annotation.colorbar]\nshow = false\nscale = \"log\"\n");
  return texts;
}

/// A section as a comment: what is not one yet becomes one.
std::string commented(const std::string& section) {
  std::istringstream lines(section);
  std::string text = "\n", line;
  while (std::getline(lines, line)) text += (line.starts_with('#') ? "" : "# ") + line + "\n";
  return text;
}

}  // namespace

std::string to_toml(const Scene& scene, Comments comments) {
  std::optional<ColorSource> color;
  if (scene.volume.color) color.emplace().transfer = *scene.volume.color;
  return scene_text(scene, color, comments);
}

std::string to_toml(const Scene& scene, const Annotation& annotation, Comments comments) {
  std::string text = to_toml(scene, comments);
  if (annotation != Annotation{})
    for (const std::string& table : annotation_texts(annotation, comments)) text += "\n" + table;
  return text;
}

std::string starter_text(const Scene& scene, const std::string& preset,
                         const std::array<double, 2>& range) {
  ColorSource color;
  color.transfer.field = scene.volume.color->field;
  color.preset = preset;
  // a range has an extent
  const double widened = range[0] < range[1] ? 0 : std::max(1.0, std::fabs(range[0]));
  color.range.fixed = {range[0] - widened, range[1] + widened};
  std::string text = scene_text(scene, color, Comments::explain);
  if (scene.isosurfaces.empty()) {
    Isosurface surface;
    surface.field = color.transfer.field;
    surface.value = 0.5 * range[0] + 0.5 * range[1];
    text +=
        commented("[[isosurface]]\n" + keys_text(isosurface_keys(), surface, Comments::explain));
  }
  if (!scene.skin) text += commented(skin_text(Skin{}, Comments::explain).substr(1));
  if (!scene.edges) text += commented(edges_text(Edges{}, Comments::explain).substr(1));
  Turntable turntable;
  turntable.frames = 36;
  text += commented("[turntable]  # or keyframes, [[camera]] with frame = N, and:\n" +
                    keys_text(turntable_keys(), turntable, Comments::explain));
  text += commented("[camera_path]\n" +
                    keys_text(camera_path_keys(), KeyframePath{}, Comments::explain));
  Annotation annotation;
  annotation.title.emplace().text = "A title";
  annotation.time.emplace();
  annotation.axes.emplace();
  annotation.scale.emplace();
  annotation.color_bar.emplace();
  for (const std::string& table : annotation_texts(annotation, Comments::explain))
    text += commented(table);
  return text;
}

}  // namespace hiac
