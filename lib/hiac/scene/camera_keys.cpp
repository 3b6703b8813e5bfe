#include "hiac/scene/camera_keys.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "hiac/geometry/vector.hpp"
#include "hiac/scene/camera_path.hpp"

namespace hiac {
namespace {

using Text = std::optional<std::string>;

constexpr std::pair<std::string_view, Projection> kProjections[] = {
    {"perspective", Projection::perspective}, {"orthographic", Projection::orthographic}};
constexpr std::pair<std::string_view, PathInterpolation> kPathInterpolations[] = {
    {"catmull-rom", PathInterpolation::catmull_rom}, {"linear", PathInterpolation::linear}};

void read_clip(const SpecValue& value, Camera& camera) {
  const std::vector<SpecValue> planes = value.list(2);
  const std::array<double, 2> clip{planes[0].number(), planes[1].number_or_infinity()};
  if (!(clip[0] < clip[1]))
    value.fail(fmt::format("near must be below far (found near {}, far {})", clip[0], clip[1]));
  camera.clip = clip;
}

void read_fov(const SpecValue& value, Camera& camera) {
  camera.fov = value.number();
  if (camera.fov > 0 && camera.fov < kLeastFov)
    value.fail(fmt::format("too small (expected at least {}, found {})", kLeastFov, camera.fov));
  if (!(camera.fov > 0 && camera.fov < 180))
    value.fail(
        fmt::format("an angle between 0 and 180 degrees, both excluded, is expected "
                    "(found {})",
                    camera.fov));
}

void read_axis(const SpecValue& value, Turntable& turntable) {
  turntable.axis = value.triple();
  if (*turntable.axis == std::array<double, 3>{}) value.fail("a direction cannot be zero");
}

void read_degrees(const SpecValue& value, Turntable& turntable) {
  turntable.degrees = value.number();
  if (turntable.degrees == 0) value.fail("expected an angle other than 0");
}

constexpr SpecKey<Camera> kCameraKeys[] = {
    {"projection", "\"perspective\" or \"orthographic\"", false,
     [](const SpecValue& v, Camera& c) { c.projection = v.name_of<Projection>(kProjections); },
     [](const Camera& c) -> Text { return name_text<Projection>(kProjections, c.projection); }},
    {"eye", "world units", true, [](const SpecValue& v, Camera& c) { c.eye = v.triple(); },
     [](const Camera& c) -> Text { return toml_text(c.eye); }},
    {"look_at", "seen at the image's centre", true,
     [](const SpecValue& v, Camera& c) { c.look_at = v.triple(); },
     [](const Camera& c) -> Text { return toml_text(c.look_at); }},
    {"up", "points up in the image", true, [](const SpecValue& v, Camera& c) { c.up = v.triple(); },
     [](const Camera& c) -> Text { return toml_text(c.up); }},
    {"fov", "perspective: the image's vertical angle, degrees", false, read_fov,
     [](const Camera& c) -> Text {
       if (c.projection != Projection::perspective) return std::nullopt;
       return toml_text(c.fov);
     }},
    {"height", "orthographic: the image's vertical extent, world units", false,
     [](const SpecValue& v, Camera& c) { c.height = v.positive(); },
     [](const Camera& c) -> Text {
       if (c.projection != Projection::orthographic) return std::nullopt;
       return toml_text(c.height);
     }},
    {"clip", "[near, far]: distances from the eye plane along the view direction", false, read_clip,
     [](const Camera& c) -> Text {
       if (!c.clip) return std::nullopt;
       return toml_text(*c.clip);
     }},
};

constexpr SpecKey<KeyframePath> kCameraPathKeys[] = {
    {"interpolation", "of eye and look_at between keyframes: \"catmull-rom\" or \"linear\"", false,
     [](const SpecValue& v, KeyframePath& p) {
       p.interpolation = v.name_of<PathInterpolation>(kPathInterpolations);
     },
     [](const KeyframePath& p) -> Text {
       return name_text<PathInterpolation>(kPathInterpolations, p.interpolation);
     }},
};

constexpr SpecKey<Turntable> kTurntableKeys[] = {
    {"frames", "number of views around look_at", true,
     [](const SpecValue& v, Turntable& t) { t.frames = v.whole(1, kMaxFrames); },
     [](const Turntable& t) -> Text { return std::to_string(t.frames); }},
    {"degrees", "turned through by all frames; 360 makes a seamless loop", false, read_degrees,
     [](const Turntable& t) -> Text { return toml_text(t.degrees); }},
    {"axis", "turned about, through look_at; without it the camera's up", false, read_axis,
     [](const Turntable& t) -> Text {
       if (!t.axis) return std::nullopt;
       return toml_text(*t.axis);
     }},
};

/// Returns the vector scaled so that its largest component is 1 or -1, which prevents overflow and
/// underflow in products.
std::array<double, 3> scaled(std::array<double, 3> v) {
  const double largest = std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
  for (double& component : v) component /= largest;
  return v;
}

/// Why a camera is unusable, and the key that causes it.
struct CameraFault {
  std::string_view key;
  std::string_view what;
};

std::optional<CameraFault> fault_of(const Camera& camera) {
  const std::array<double, 3> towards = view_direction(camera);
  if (towards == std::array<double, 3>{}) return CameraFault{"look_at", "the same point as `eye`"};
  for (const double component : towards)
    if (!std::isfinite(component)) return CameraFault{"look_at", "too far from `eye`"};
  if (camera.up == std::array<double, 3>{}) return CameraFault{"up", "a direction cannot be zero"};
  // below this sine, only four digits of the image's right vector are left
  constexpr double kSmallestSine = 1e-12;
  const auto d = scaled(towards);
  const auto u = scaled(camera.up);
  const std::array<double, 3> right{d[1] * u[2] - d[2] * u[1], d[2] * u[0] - d[0] * u[2],
                                    d[0] * u[1] - d[1] * u[0]};
  if (!(length(right) > kSmallestSine * length(d) * length(u)))
    return CameraFault{"up", "parallel to the view direction from `eye` to `look_at`"};
  return std::nullopt;
}

/// Throws unless the table's camera is usable.
void check_camera(const SpecValue& table, const Camera& camera) {
  const bool perspective = camera.projection == Projection::perspective;
  const char* needed = perspective ? "fov" : "height";
  const char* useless = perspective ? "height" : "fov";
  const std::string_view projection = perspective ? "perspective" : "orthographic";
  if (!table.has(needed))
    table.fail_at(needed,
                  fmt::format("is missing (a camera of {} projection needs it)", projection));
  if (table.has(useless))
    table.fail_at(useless, fmt::format("has no meaning in {} projection (remove it)", projection));
  if (const auto fault = fault_of(camera)) table.fail_at(fault->key, std::string(fault->what));
  if (perspective && camera.clip && (*camera.clip)[0] < 0)
    table.fail_at("clip", fmt::format("near is behind the eye (expected at least 0, found {})",
                                      (*camera.clip)[0]));
}

std::vector<std::string_view> camera_key_names() {
  std::vector<std::string_view> names;
  for (const SpecKey<Camera>& key : camera_keys()) names.push_back(key.name);
  return names;
}

/// Throws unless a keyframe is a valid successor of the one before it.
void check_succession(const SpecValue& table, const Keyframe& before, const Keyframe& keyframe) {
  if (keyframe.frame <= before.frame)
    table.fail_at("frame", fmt::format("frames must ascend (found {} after {})", keyframe.frame,
                                       before.frame));
  if (keyframe.camera.projection != before.camera.projection)
    table.fail_at("projection", "must be that of the first keyframe");
  if (keyframe.camera.clip.has_value() != before.camera.clip.has_value())
    table.fail_at("clip", "is missing in the first keyframe");
}

KeyframePath read_keyframes(const SpecValue& list) {
  std::vector<std::string_view> names = camera_key_names();
  names.emplace_back("frame");
  KeyframePath path;
  for (const SpecValue& table : list.tables()) {
    refuse_unknown_keys(table, names);
    Keyframe keyframe;
    if (!table.has("frame")) table.fail_at("frame", "is missing (every keyframe needs it)");
    keyframe.frame = table.child("frame").whole(0, kMaxFrames - 1);
    read_known_keys(table, camera_keys(), keyframe.camera);
    // comes before the check of the camera, as one of another projection inherits a key without use
    if (!path.keyframes.empty())
      check_succession(table, path.keyframes.back(), keyframe);
    else if (keyframe.frame != 0)
      table.fail_at("frame",
                    fmt::format("the first keyframe must be at 0 (found {})", keyframe.frame));
    check_camera(table, keyframe.camera);
    path.keyframes.push_back(keyframe);
  }
  if (path.keyframes.empty()) list.fail("empty (expected at least one keyframe)");
  return path;
}

}  // namespace

std::span<const SpecKey<Camera>> camera_keys() { return kCameraKeys; }
std::span<const SpecKey<KeyframePath>> camera_path_keys() { return kCameraPathKeys; }
std::span<const SpecKey<Turntable>> turntable_keys() { return kTurntableKeys; }

void inherit_keyframes(toml::table& document) {
  toml::array* keyframes = document["camera"].as_array();
  if (keyframes == nullptr) return;
  const toml::table* before = nullptr;
  for (toml::node& node : *keyframes) {
    toml::table* keyframe = node.as_table();
    if (keyframe == nullptr) return;  // rejected when it is read
    if (before != nullptr)
      for (const auto& [key, value] : *before)
        if (key != "frame") keyframe->insert(key, value);  // does not replace existing keys
    before = keyframe;
  }
}

void read_cameras(const SpecValue& value, Scene& scene) {
  if (value.is_list()) {
    const KeyframePath path = read_keyframes(value);
    scene.camera = path.keyframes.front().camera;
    scene.path = path;
  } else {
    refuse_unknown_keys(value, camera_key_names());
    read_known_keys(value, camera_keys(), scene.camera);
    check_camera(value, scene.camera);
  }
}

void read_camera_path(const SpecValue& table, Scene& scene) {
  if (!scene.path)
    table.fail("has no meaning without keyframes (a list [[camera]] expected, one [camera] found)");
  read_keys(table, camera_path_keys(), std::get<KeyframePath>(*scene.path));
}

void read_turntable(const SpecValue& table, Scene& scene) {
  if (scene.path)
    table.fail("has no meaning with keyframes (one [camera] expected, a list [[camera]] found)");
  Turntable turntable;
  read_keys(table, turntable_keys(), turntable);
  scene.path = turntable;
}

void check_camera_path(const SpecValue& document, const Scene& scene) {
  if (!scene.path) return;
  const std::string_view key =
      std::holds_alternative<Turntable>(*scene.path) ? "turntable" : "camera";
  for (std::uint32_t frame = 0; frame < frame_count(scene); ++frame)
    if (const auto fault = fault_of(camera_at(scene, frame)))
      document.fail_at(key, fmt::format("the path makes no view at frame {}: its `{}` is {}", frame,
                                        fault->key, fault->what));
}

}  // namespace hiac
