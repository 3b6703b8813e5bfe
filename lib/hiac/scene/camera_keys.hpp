#pragma once

#include <span>

#include <toml++/toml.h>

#include "hiac/scene/scene.hpp"
#include "hiac/scene/toml/spec_key.hpp"

namespace hiac {

/// The keys of a camera, and of the tables [camera_path] and [turntable].
std::span<const SpecKey<Camera>> camera_keys();
std::span<const SpecKey<KeyframePath>> camera_path_keys();
std::span<const SpecKey<Turntable>> turntable_keys();

/// Copies to every keyframe but the first the keys that it omits from the keyframe before it. Call
/// this before reading any key.
void inherit_keyframes(toml::table& document);

/// Reads [camera], or the keyframes [[camera]].
void read_cameras(const SpecValue& value, Scene& scene);
/// Reads the interpolation between the keyframes, which must exist.
void read_camera_path(const SpecValue& table, Scene& scene);
/// Reads the turntable; [camera] must be a single camera.
void read_turntable(const SpecValue& table, Scene& scene);

/// Throws unless the cameras of all frames of the scene's path are usable.
void check_camera_path(const SpecValue& document, const Scene& scene);

}  // namespace hiac
