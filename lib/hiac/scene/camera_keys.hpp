#pragma once

#include <span>

#include <toml++/toml.h>

#include "hiac/scene/scene.hpp"
#include "hiac/scene/spec_key.hpp"

namespace hiac {

/// The keys of a camera, of the table [camera_path] and of the table [turntable].
std::span<const SpecKey<Camera>> camera_keys();
std::span<const SpecKey<KeyframePath>> camera_path_keys();
std::span<const SpecKey<Turntable>> turntable_keys();

/// Gives every keyframe but the first what it does not name from the one before it. To be done
/// before anything is read.
void inherit_keyframes(toml::table& document);

/// Reads [camera], or the keyframes [[camera]].
void read_cameras(const SpecValue& value, Scene& scene);
/// Reads how the keyframes, which must be there, are joined.
void read_camera_path(const SpecValue& table, Scene& scene);
/// Reads the turntable on which [camera], which must be one, stands.
void read_turntable(const SpecValue& table, Scene& scene);

/// Throws unless the camera of every frame of the scene's path can be used.
void check_camera_path(const SpecValue& document, const Scene& scene);

}  // namespace hiac
