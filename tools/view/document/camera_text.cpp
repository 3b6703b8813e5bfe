#include "tools/view/document/camera_text.hpp"

#include <algorithm>
#include <regex>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/camera_keys.hpp"
#include "hiac/scene/toml/edited_text.hpp"

namespace hiac::view {

std::optional<std::size_t> keyframe_at(const Scene& scene, std::uint32_t frame) {
  const auto* path = scene.path ? std::get_if<KeyframePath>(&*scene.path) : nullptr;
  if (path == nullptr) return frame == 0 ? std::optional<std::size_t>(0) : std::nullopt;
  const auto found = std::ranges::find(path->keyframes, frame, &Keyframe::frame);
  if (found == path->keyframes.end()) return std::nullopt;
  return static_cast<std::size_t>(found - path->keyframes.begin());
}

namespace {

constexpr const char* kLabel = "keyframe";

std::string set_keys(std::string text, const std::string& table, const Camera& camera) {
  for (const SpecKey<Camera>& key : camera_keys())
    if (const auto value = key.write(camera))
      text = with_key(text, fmt::format("{}.{}", table, key.name), *value);
  return text;
}

// One camera as a list of one keyframe, whose comments stay.
std::string as_list(const std::string& text) {
  static const std::regex kHeader(R"((^|\n)([ \t]*)\[[ \t]*camera[ \t]*\])");
  const std::string list = std::regex_replace(text, kHeader, "$1$2[[camera]]\n$2frame = 0",
                                              std::regex_constants::format_first_only);
  if (list == text)
    throw UsageError(
        fmt::format("{}: the camera is not a table with a header ([camera] expected)", kLabel));
  return list;
}

std::vector<std::pair<std::string, std::string>> keys_of(const Keyframe& keyframe) {
  std::vector<std::pair<std::string, std::string>> keys{{"frame", std::to_string(keyframe.frame)}};
  for (const SpecKey<Camera>& key : camera_keys())
    if (const auto value = key.write(keyframe.camera)) keys.emplace_back(key.name, *value);
  return keys;
}

}  // namespace

std::string with_camera(std::string text, const Scene& scene, std::size_t keyframe,
                        const Camera& after) {
  const auto* path = scene.path ? std::get_if<KeyframePath>(&*scene.path) : nullptr;
  const std::string table = path != nullptr ? fmt::format("camera.{}", keyframe) : "camera";
  const Camera& before = path != nullptr ? path->keyframes.at(keyframe).camera : scene.camera;
  for (const SpecKey<Camera>& key : camera_keys()) {
    const auto old_value = key.write(before), value = key.write(after);
    if (old_value == value) continue;
    // the next keyframe keeps what it may have had from this one
    if (path != nullptr && keyframe + 1 < path->keyframes.size()) {
      const std::string next = fmt::format("camera.{}.{}", keyframe + 1, key.name);
      if (const auto kept = key.write(path->keyframes[keyframe + 1].camera))
        text = with_key(text, next, *kept);
    }
    const std::string place = fmt::format("{}.{}", table, key.name);
    text = value ? with_key(text, place, *value) : without_key(text, place);
  }
  return text;
}

std::string with_keyframe(std::string text, const Scene& scene, std::uint32_t frame,
                          const Camera& camera) {
  if (!scene.path) {
    if (frame == 0)
      throw UsageError(
          fmt::format("{}: frame 0 is the present camera (a frame from 1 expected)", kLabel));
    return with_table(as_list(text), "camera.1", keys_of({frame, camera}));
  }
  const auto* path = std::get_if<KeyframePath>(&*scene.path);
  if (path == nullptr)
    throw UsageError(fmt::format("{}: the path is a turntable, which has none", kLabel));
  std::vector<Keyframe> keyframes = path->keyframes;
  const auto place = std::ranges::lower_bound(keyframes, frame, {}, &Keyframe::frame);
  const auto at = static_cast<std::size_t>(place - keyframes.begin());
  if (place != keyframes.end() && place->frame == frame)
    return with_camera(std::move(text), scene, at, camera);
  keyframes.insert(place, {frame, camera});
  const std::size_t last = keyframes.size() - 1;
  text = with_table(text, fmt::format("camera.{}", last), keys_of(keyframes[last]));
  for (std::size_t k = at; k < last; ++k) {
    const std::string table = fmt::format("camera.{}", k);
    text = with_key(text, table + ".frame", std::to_string(keyframes[k].frame));
    text = set_keys(std::move(text), table, keyframes[k].camera);
  }
  return text;
}

}  // namespace hiac::view
